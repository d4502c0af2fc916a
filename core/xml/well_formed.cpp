#include "core/xml/well_formed.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/utf8.h"
#include "core/xml/canvas.h"
#include "core/xml/source_tree.h"

namespace forage::xml {
namespace {

/// Scans a text. A function that finds a fault reports it and returns false.
class Scanner {
  public:
    Scanner(const Document& document, std::string_view beginning, std::size_t max_nodes,
            Diagnostics& diagnostics)
        : document_(&document),
          text_(document.source->text),
          beginning_(beginning),
          max_nodes_(max_nodes),
          diagnostics_(&diagnostics) {}
    explicit Scanner(std::string_view text) : text_(text) {}

    std::optional<std::string_view> run() {
        return characters() && content() ? std::optional(root_) : std::nullopt;
    }
    /// The outermost element of a text without faults.
    SourceElement tree() {
        content();
        auto& outermost = open_.front().children;
        return outermost.empty() ? SourceElement() : std::move(outermost.front());
    }

  private:
    static constexpr std::size_t deepest = 64;  // a system file has seven levels
    static constexpr std::string_view blanks = " \t\r\n";

    static bool begins_name(char c) {
        return std::isalpha(static_cast<unsigned char>(c)) || c == '_' || c == ':' || (c & 0x80);
    }
    static bool continues_name(char c) {
        return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '.';
    }

    bool fail(std::size_t offset, std::string message, std::string hint = {}) {
        if (!document_) return false;
        Location where = document_->place(text_.data() + std::min(offset, text_.size()));
        // No excerpt of a file of another kind: it may be private, and a model from elsewhere may name it.
        if (!looks_like_xml()) where.file = std::make_shared<SourceFile>(SourceFile{where.file->path, {}});
        diagnostics_->error(std::move(where), std::move(message), std::move(hint));
        return false;
    }
    bool fail_whole(std::string message, std::string hint) {
        if (document_) diagnostics_->error({document_->source, 0, 0}, std::move(message), std::move(hint));
        return false;
    }
    std::string begins() const { return fmt::format("a file of this kind begins with {}", beginning_); }
    bool looks_like_xml() const {
        return text_.find_first_not_of(" \t\r\n\xef\xbb\xbf") == text_.find('<') &&
               text_.find('<') < text_.size();
    }
    bool at(std::string_view what) const { return text_.substr(pos_).starts_with(what); }
    std::size_t offset(std::string_view part) const {
        return static_cast<std::size_t>(part.data() - text_.data());
    }
    std::size_t skip_blanks() {
        const std::size_t from = pos_;
        pos_ = std::min(text_.find_first_not_of(blanks, pos_), text_.size());
        return pos_ - from;
    }
    std::string_view name() {
        const std::size_t from = pos_;
        if (pos_ < text_.size() && begins_name(text_[pos_]))
            while (pos_ < text_.size() && continues_name(text_[pos_])) ++pos_;
        return text_.substr(from, pos_ - from);
    }

    bool characters() {
        if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff") ||
            (text_.size() > 1 && text_[0] == '<' && text_[1] == '\0'))
            return fail_whole("the file is encoded as UTF-16", "save it as UTF-8");
        for (std::size_t i = 0; i < text_.size();) {
            const auto c = static_cast<unsigned char>(text_[i]);
            if (c < 0x20 && c != '\t' && c != '\n' && c != '\r')
                return fail(i, fmt::format("the byte 0x{:02x} does not occur in a text", c),
                            looks_like_xml() ? "remove it" : "is this an XML file?");
            const std::size_t length = utf8_length(text_.substr(i));
            if (length == 0)
                return fail(i, fmt::format("the byte 0x{:02x} is not UTF-8", c),
                            looks_like_xml()
                                ? "save the file as UTF-8, whatever encoding its first line names"
                                : "is this an XML file?");
            i += length;
        }
        return true;
    }

    bool content() {
        if (at("\xef\xbb\xbf")) pos_ = 3;  // byte order mark
        if (text_.find_first_not_of(blanks, pos_) == std::string_view::npos)
            return fail_whole("the file is empty", begins());
        while (pos_ < text_.size()) {
            const std::size_t open = std::min(text_.find('<', pos_), text_.size());
            if (!plain_text(pos_, open)) return false;
            pos_ = open;
            if (pos_ < text_.size() && !markup()) return false;
        }
        if (open_.size() > 1) {
            const std::string_view last = open_.back().name;
            return fail(offset(last) - 1, fmt::format("<{}> is not closed before the file ends", last),
                        fmt::format("is the file complete? A </{}> is missing", last));
        }
        return root_.empty() ? fail_whole("the file holds no element", begins()) : true;
    }

    bool plain_text(std::size_t from, std::size_t to) {
        const std::size_t first = text_.find_first_not_of(blanks, from);
        if (first >= to) return true;
        if (open_.size() == 1)
            return fail(
                first,
                root_.empty() ? "there is text before the first element"
                              : fmt::format("there is text after the end of <{}>", root_),
                looks_like_xml() ? "remove it, or make it a comment: <!-- -->" : "is this an XML file?");
        return references(from, to);
    }

    /// Checks that every '&' begins one of the five entities of XML or a numeric character reference.
    bool references(std::size_t from, std::size_t to) {
        const std::string_view text = text_.substr(0, to);  // limits the search
        for (std::size_t i = text.find('&', from); i < to; i = text.find('&', i + 1)) {
            const std::size_t end = text.find(';', i);
            const auto what = end < to ? text.substr(i + 1, end - i - 1) : std::string_view();
            if (what == "lt" || what == "gt" || what == "amp" || what == "quot" || what == "apos" ||
                is_character(what))
                continue;
            if (what.starts_with('#') && what.size() < 40)
                return fail(
                    i, fmt::format("'&{};' is not a character that XML allows", what),
                    "&#N; is a character by its number in Unicode; control characters have none here");
            if (!what.empty() && std::ranges::all_of(what, continues_name))
                return fail(
                    i, fmt::format("there is no entity '&{};'", what),
                    "XML has &lt; &gt; &amp; &quot; and &apos;; other characters stand for themselves");
            return fail(i, "a '&' that begins no entity", "a '&' itself is written &amp;");
        }
        return true;
    }

    static bool is_character(std::string_view reference) {
        if (!reference.starts_with('#')) return false;
        const bool hex = reference.starts_with("#x");
        reference.remove_prefix(hex ? 2 : 1);
        unsigned code = 0;
        const auto [end, error] =
            std::from_chars(reference.data(), reference.data() + reference.size(), code, hex ? 16 : 10);
        return error == std::errc{} && end == reference.data() + reference.size() &&
               (code >= 0x20 || code == 9 || code == 10 || code == 13) && code <= 0x10ffff &&
               (code < 0xd800 || code > 0xdfff);
    }

    bool markup() {
        const bool only_instructions = std::exchange(only_instructions_, at("<?"));
        if (at("<?"))
            return only_instructions ? skip("<?", "?>", "the declaration that begins here is not closed")
                                     : fail(pos_, "a '<?' stands after another thing than a '<?'",
                                            "move it to the beginning of the file, after the <?xml?>");
        if (at("<!--")) {
            const std::size_t start = pos_;
            if (!skip("<!--", "-->", "the comment that begins here is not closed")) return false;
            const std::string_view inside = text_.substr(start + 4, pos_ - start - 7);
            const std::size_t dashes = inside.find("--");
            if (dashes != std::string_view::npos || inside.ends_with('-'))
                return fail(start + 4 + std::min(dashes, inside.size() - 1),
                            "two dashes within a comment, which XML does not allow",
                            "write one dash, or a blank between them");
            if (!document_) keep_comment({start, pos_}, inside);
            return true;
        }
        if (at("<![CDATA["))
            return open_.size() == 1
                       ? fail(pos_, "there is text outside of the first element")
                       : skip("<![CDATA[", "]]>", "the CDATA section that begins here is not closed");
        if (at("<!")) {
            const std::size_t end = std::min(text_.find('>', pos_), text_.size());
            const std::size_t bracket = text_.substr(0, end).find('[', pos_);
            if (bracket < end)
                return fail(bracket, "a document type with declarations of its own is not read",
                            "remove all from '[' to ']'");
            return skip("<!", ">", "the declaration that begins here is not closed");
        }
        return at("</") ? end_tag() : start_tag();
    }

    bool skip(std::string_view begin, std::string_view end, std::string message) {
        const std::size_t close = text_.find(end, pos_ + begin.size());
        if (close == std::string_view::npos)
            return fail(pos_, std::move(message), fmt::format("it ends with {}", end));
        if (!counted(pos_)) return false;
        pos_ = close + end.size();
        return true;
    }

    bool end_tag() {
        const std::size_t start = pos_;
        pos_ += 2;
        const std::string_view closes = name();
        skip_blanks();
        if (closes.empty() || !at(">"))
            return fail(start, "a damaged end tag", "an end tag is written </Name>");
        ++pos_;
        if (open_.size() == 1) return fail(start, fmt::format("</{}> closes nothing", closes));
        const std::string_view last = open_.back().name;
        if (last != closes) {
            const bool is_open = std::ranges::find(open_, closes, &SourceElement::name) != open_.end();
            return fail(start,
                        fmt::format("</{}> comes before <{}> of line {} is closed", closes, last,
                                    document_ ? document_->place(last.data()).line : 0),
                        is_open ? fmt::format("close it with </{}>, or end its start tag with '/>'", last)
                                : fmt::format("no <{}> is open here; is </{}> meant?", closes, last));
        }
        auto element = std::move(open_.back());
        open_.pop_back();
        element.content.end = start;
        close(std::move(element));
        return true;
    }

    /// Adds an element that ends here to the one around it.
    void close(SourceElement element) {
        element.whole.end = pos_;
        if (!document_) open_.back().children.push_back(std::move(element));
    }
    /// Adds a comment, or the part of the diagram in it, to the element around it.
    void keep_comment(Span comment, std::string_view inside) {
        if (!read_canvas_part(inside)) return open_.back().comments.push_back(comment);
        SourceElement e;
        pos_ = comment.begin + 4;
        skip_blanks();
        e.name = name();
        for (skip_blanks(); !at("-->") && attribute(e, 1); skip_blanks()) {
        }
        pos_ = comment.end;
        e.closed = false;
        e.tag = comment, e.content = {pos_, pos_}, e.whole.begin = comment.begin;
        close(std::move(e));
    }

    bool start_tag() {
        const std::size_t start = pos_++;
        const std::string_view tag = name();
        if (tag.empty()) return fail(start, "a '<' that begins no element", "a '<' itself is written &lt;");
        if (open_.size() == 1 && !root_.empty())
            return fail(start, fmt::format("<{}> stands after the end of <{}>", tag, root_),
                        "a file holds one outermost element");
        if (open_.size() > deepest)
            return fail(start, fmt::format("<{}> is nested more than {} elements deep", tag, deepest));
        if (!counted(start)) return false;
        if (root_.empty()) root_ = tag;
        SourceElement e;
        e.name = tag, e.whole.begin = e.tag.begin = start;
        while (true) {
            const std::size_t gap = skip_blanks();
            e.closed = at(">");
            if (e.closed || at("/>")) {
                pos_ = e.tag.end = pos_ + (e.closed ? 1 : 2);
                e.content = {pos_, pos_};
                e.closed ? open_.push_back(std::move(e)) : close(std::move(e));
                return true;
            }
            if (pos_ >= text_.size() || at("<"))
                return fail(
                    start, fmt::format("the start tag <{}> is not closed", tag),
                    pos_ >= text_.size() ? "is the file complete?" : "a start tag ends with '>' or '/>'");
            if (!attribute(e, gap)) return false;
        }
    }

    /// Reads an attribute of the element, after a gap of so many blanks.
    bool attribute(SourceElement& e, std::size_t gap) {
        const std::string_view tag = e.name;
        const std::size_t start = pos_;
        const std::string_view attribute = name();
        // When a closing quote is missing, the first quote of the next value closes instead, and the text of
        // that value stands where a name should be.
        if (auto& all = e.attributes; (attribute.empty() || gap == 0) && !all.empty() &&
                                      all.back().value.find('=') != std::string_view::npos)
            return fail(offset(all.back().value) - 1,
                        fmt::format("the value of '{}' has no closing quote", all.back().name),
                        "attributes are written name=\"value\"");
        if (attribute.empty())
            return fail(start, fmt::format("no attribute of <{}> can begin here", tag),
                        "attributes are written name=\"value\"");
        if (gap == 0)
            return fail(start, fmt::format("there is no blank before the attribute '{}'", attribute),
                        "attributes are written name=\"value\", with a blank between them");
        if (e.attribute(attribute))
            return fail(start, fmt::format("<{}> has the attribute '{}' twice", tag, attribute),
                        "remove one of them");
        constexpr std::size_t most = 1000;  // each is compared with all previous ones
        if (e.attributes.size() >= most)
            return fail(start, fmt::format("<{}> has more than {} attributes", tag, most));
        if (!counted(start)) return false;
        skip_blanks();
        if (!at("="))
            return fail(start, fmt::format("the attribute '{}' has no value", attribute),
                        fmt::format("it is written {}=\"value\"", attribute));
        ++pos_;
        skip_blanks();
        if (!at("\"") && !at("'"))
            return fail(pos_, fmt::format("the value of '{}' does not begin with a quote", attribute),
                        fmt::format("it is written {}=\"value\"", attribute));
        const char quote = text_[pos_];
        const std::size_t from = ++pos_, to = text_.find(quote, from);
        const std::size_t bracket = text_.substr(0, to).find('<', from);
        if (to == std::string_view::npos || bracket < to)
            return fail(from - 1, fmt::format("the value of '{}' has no closing quote", attribute),
                        bracket < to ? "or a '<' in it, which is written &lt;" : "is the file complete?");
        pos_ = to + 1;
        e.attributes.push_back({attribute, text_.substr(from, to - from), {start, pos_}, {from, to}});
        return references(from, to);
    }

    bool counted(std::size_t where) {
        return ++nodes_ <= max_nodes_ ||
               fail(where,
                    fmt::format("the file has more than {} elements, attributes and comments", max_nodes_));
    }

    const Document* document_ = nullptr;  ///< null when all elements are kept, instead of reporting faults
    std::string_view text_, beginning_;
    std::size_t max_nodes_ = std::numeric_limits<std::size_t>::max();
    Diagnostics* diagnostics_ = nullptr;
    std::size_t pos_ = 0, nodes_ = 0;
    bool only_instructions_ =
        true;  ///< whether nothing else has come so far; tinyxml2 reads instructions only there
    std::string_view root_;
    std::vector<SourceElement> open_{1};  ///< open elements, around which the first one stands
};

}  // namespace

std::optional<std::string_view> find_root(const Document& document, std::string_view beginning,
                                          std::size_t max_nodes, Diagnostics& diagnostics) {
    return Scanner(document, beginning, max_nodes, diagnostics).run();
}

SourceElement scan(std::string_view text) { return Scanner(text).tree(); }

}  // namespace forage::xml
