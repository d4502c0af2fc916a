#include "bug_interface/world/sdf_parser.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <deque>
#include <exception>
#include <iostream>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "bug_interface/world/model_folders.h"
#include "bug_interface/world/sdf_text.h"
#include "core/xml/well_formed.h"

namespace forage::bug {
namespace {

/// Elements and attributes of a file: the library takes about 10 kB for each.
constexpr std::size_t most_nodes = 10'000;

/// Collects what is written to std::cerr: the library gives its reasons only there, and we print them
/// ourselves.
class CapturedErrors {
  public:
    CapturedErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
    ~CapturedErrors() { std::cerr.rdbuf(before_); }
    CapturedErrors(const CapturedErrors&) = delete;
    CapturedErrors& operator=(const CapturedErrors&) = delete;

    /// Without the colours.
    std::string text() const {
        std::string out = text_.str();
        for (auto from = out.find("\x1b["); from != std::string::npos; from = out.find("\x1b[", from))
            out.erase(from, std::min(out.find('m', from), out.size() - 1) - from + 1);
        return out;
    }

  private:
    std::ostringstream text_;
    std::streambuf* before_;
};

/// The library opens a log file below $HOME when its console is first used, and has no switch against that.
/// It goes without one when the directory cannot be made, so HOME points elsewhere during this one call.
void make_console_without_log_file() {
    static std::once_flag done;
    std::call_once(done, [] {
        const char* home = std::getenv("HOME");
        const std::optional<std::string> before = home ? std::optional<std::string>(home) : std::nullopt;
        setenv("HOME", "/dev/null", 1);
        sdf::Console::Instance();
        if (before)
            setenv("HOME", before->c_str(), 1);
        else
            unsetenv("HOME");
    });
}

/// What stands between `before` and `after`; empty when they are not there.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
    const auto from = text.find(before);
    if (from == std::string_view::npos) return {};
    text.remove_prefix(from + before.size());
    const auto to = text.find(after);
    return to == std::string_view::npos ? std::string_view{} : text.substr(0, to);
}

/// The library's reasons: what follows "Error [file.cc:123] " in each line.
std::vector<std::string_view> reasons(std::string_view console) {
    std::vector<std::string_view> out;
    while (!console.empty()) {
        const auto end = std::min(console.find('\n'), console.size());
        const std::string_view line = console.substr(0, end);
        if (const auto text = line.find("] "); line.starts_with("Error [") && text != std::string_view::npos)
            out.push_back(line.substr(text + 2));
        console.remove_prefix(std::min(end + 1, console.size()));
    }
    return out;
}

/// Where a line begins; lines count from 1.
std::size_t line_begin(std::string_view text, int line) {
    std::size_t out = 0;
    for (; line > 1 && out < text.size(); --line) out = std::min(text.find('\n', out), text.size() - 1) + 1;
    return out;
}

/// Where `what` begins in a line of `text`, or else its first tag; counts from 1. 0: there is none. (The
/// library counts lines only.)
int column_of(std::string_view what, std::string_view text, int line) {
    text.remove_prefix(line_begin(text, line));
    text = text.substr(0, text.find('\n'));
    auto column = text.find(what);
    if (column == std::string_view::npos) column = text.find('<');
    return column == std::string_view::npos ? 0 : static_cast<int>(column) + 1;
}

int number(std::string_view text) {
    int out = 0;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
}

std::string plain_words(std::string_view xml_error) {
    if (xml_error.starts_with("XML_ERROR_")) xml_error.remove_prefix(10);
    std::string out(xml_error);
    for (char& c : out) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

constexpr const char* pose_hint = "a pose is x y z roll pitch yaw: six numbers, in m and rad";

/// What an element holds, for a hint.
std::string expected(std::string_view element) {
    if (element == "pose") return pose_hint;
    if (element == "size") return "numbers in m with spaces between them: three for a box, two for a plane";
    if (element == "direction" || element == "normal" || element == "gravity")
        return "three numbers with spaces between them";
    if (element == "ambient" || element == "diffuse" || element == "specular")
        return "a colour is red green blue alpha, each from 0 to 1";
    return {};
}

}  // namespace

SdfParser::SdfParser(Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    make_console_without_log_file();
    document_ = std::make_shared<sdf::SDF>();
    sdf::init(document_);
}

/// Whether the library may see a file: it recurses as deep as elements are nested, and takes for URDF what is
/// not SDF.
bool SdfParser::safe(const std::string& path) {
    const auto file = at(path, 0).file;
    if (const auto fault = xml::first_fault(file->text, "<sdf version=\"1.4\">", most_nodes)) {
        diagnostics_.error(fault->of_the_whole ? Location{file, 0, 0} : location_of(file, fault->offset),
                           fault->message, fault->hint);
        return false;
    }
    const std::string root = root_name(file->text);
    if (root == "sdf" || root == "gazebo") return known_version(file, root);
    diagnostics_.error(location_of(file, file->text.find("<" + root)),
                       fmt::format("the root element is <{}>; that of a world or a model is <sdf>", root));
    return false;
}

/// The library reads versions that do not exist as its own.
bool SdfParser::known_version(const std::shared_ptr<const SourceFile>& file, const std::string& root) {
    const auto begin = file->text.find("<" + root), end = file->text.find('>', begin);
    const auto attribute = file->text.substr(0, end).find("version", begin);
    if (attribute == std::string::npos) return true;  // that it is missing is said elsewhere
    const auto value = file->text.find_first_of("\"'", attribute) + 1;
    const std::string version = file->text.substr(value, file->text.find_first_of("\"'", value) - value);
    double number = 0;
    const auto [last, error] = std::from_chars(version.data(), version.data() + version.size(), number);
    if (error == std::errc{} && last == version.data() + version.size() && number >= 1 && number < 2)
        return true;
    diagnostics_.error(location_of(file, value), fmt::format("there is no version '{}' of SDF", version),
                       "<sdf version=\"1.4\">");
    return false;
}

std::vector<sdf::ElementPtr> SdfParser::parse(const std::string& path) {
    if (!safe(path)) return {};
    sdf::ParserConfig config;
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
    // The library leaves an include as it is when it finds a file that is no SDF, and there is another parser
    // for such files. (That one is never called: only the library's object model would.)
    config.SetFindCallback([](const std::string&) { return std::string("/nowhere"); });
    config.RegisterCustomModelParser(
        [](const sdf::NestedInclude&, sdf::Errors&) -> sdf::InterfaceModelPtr { return nullptr; });
    std::vector<sdf::ElementPtr> out;
    try {
        CapturedErrors captured;
        sdf::Errors errors;
        const int errors_before = diagnostics_.errors();
        const bool good =
            sdf::readString(with_marked_uris(at(path, 0).file->text), config, document_, errors);
        report(path, errors, captured.text(), good);
        const auto root = document_->Root();
        for (auto e = root->GetFirstElement(); e; e = e->GetNextElement()) out.push_back(e);
        for (const auto& e : out) root->RemoveChild(e), settle(e, path);
        if (diagnostics_.errors() == errors_before) check_numbers(path, out);
    } catch (const std::exception& e) {  // of an empty <uri>
        const std::string text = read_text(path).value_or("");
        auto empty = std::string::npos;
        for (const char* form : {"<uri/>", "<uri />", "<uri></uri>"})
            empty = std::min(empty, text.find(form));
        if (empty == std::string::npos)
            diagnostics_.error(at(path, 0), "this file could not be read", e.what());
        else
            diagnostics_.error(
                at(path, 1 + static_cast<int>(std::count(text.data(), text.data() + empty, '\n'))),
                "<uri> is empty", "write <uri>model://NAME</uri>");
        sdf::init(document_ = std::make_shared<sdf::SDF>());
    }
    return out;
}

/// What was read from a string knows no file, and its uris are marked.
void SdfParser::settle(const sdf::ElementPtr& element, const std::string& path) {
    element->SetFilePath(path);
    if (element->GetName() == "uri" && element->GetValue())
        element->Set(without_mark(element->Get<std::string>()));
    for (auto e = element->GetFirstElement(); e; e = e->GetNextElement()) settle(e, path);
}

void SdfParser::check_numbers(const std::string& path, const std::vector<sdf::ElementPtr>& elements) {
    std::set<std::string, std::less<>> numbers, others;
    std::deque<sdf::ElementPtr> open(elements.begin(), elements.end());
    for (; !open.empty(); open.pop_front()) {
        if (const auto value = open.front()->GetValue()) {
            const std::string& type = value->GetTypeName();
            (type == "string" || type == "bool" || type == "char" ? others : numbers)
                .insert(open.front()->GetName());
        }
        for (auto e = open.front()->GetFirstElement(); e; e = e->GetNextElement()) open.push_back(e);
    }
    const auto file = at(path, 0).file;
    find_bad_numbers(
        file->text, [&](std::string_view name) { return numbers.contains(name) && !others.contains(name); },
        [&](std::size_t offset, std::string_view value) {
            diagnostics_.error(location_of(file, offset), fmt::format("'{}' is not a number", value),
                               "a number is expected here, with a point and without a unit");
        });
}

std::string SdfParser::model_file(const std::string& folder) {
    CapturedErrors unused;
    return sdf::getModelFilePath(folder);
}

void SdfParser::report(const std::string& path, const sdf::Errors& errors, const std::string& console,
                       bool good) {
    const int errors_before = diagnostics_.errors();
    const auto why = reasons(console);
    auto reason = why.begin();
    if (const auto file = between(console, "Error parsing XML in file [", "]"); !file.empty())
        diagnostics_.error(
            at(std::string(file), number(between(console, "Line number=", "\n"))),
            fmt::format("this is not well-formed XML ({})", plain_words(between(console, "]: Error=", " "))),
            "every element needs its closing tag, every attribute its quotes");
    bool inside_chain = false;  // "Error reading element" is repeated for every parent
    for (const auto& e : errors) {
        const Location where = at(path, e.LineNumber().value_or(0));
        const std::string& message = e.Message();
        const bool chain = message.starts_with("Error reading element");
        if (chain && inside_chain) continue;
        inside_chain = true;
        if (message.find("not defined in SDF") != std::string::npos) {
            report_unknown(at(where.file->path, where.line, std::string(between(message, "Element[", "]"))),
                           message);
            inside_chain = false;
        } else if (chain) {
            const std::string element(between(message, "<", ">"));
            report_reason(at(where.file->path, where.line, element), element,
                          reason == why.end() ? std::string_view{} : *reason++);
        } else if (message.find("<include> element missing 'uri'") != std::string::npos) {
            diagnostics_.error(where, "this <include> does not say what to include",
                               "write <uri>model://NAME</uri> into it");
        } else if (const auto name = between(message, "Required attribute[", "]"); !name.empty()) {
            const auto element = between(message, "in element[", "]");
            diagnostics_.error(where, fmt::format("<{}> needs the attribute '{}'", element, name),
                               fmt::format("<{} {}=\"...\">", element, name));
        } else if (const auto child = between(message, "Missing required element[", "]"); !child.empty()) {
            diagnostics_.error(
                where, fmt::format("<{}> needs a <{}>", between(message, "child of element[", "]"), child));
        } else if (const auto attribute = between(message, "Unable to read attribute[", "]");
                   !attribute.empty()) {
            diagnostics_.error(where, fmt::format("attribute '{}' cannot have this value", attribute));
        } else {
            diagnostics_.error(where, message.substr(0, message.find_last_not_of('\n') + 1));
        }
    }
    if (good || diagnostics_.errors() > errors_before) return;
    const std::string_view text = at(path, 0).file->text;
    const auto root = text.find("<sdf");
    if (root != std::string_view::npos &&
        text.substr(root, text.find('>', root) - root).find("version") == text.npos)
        diagnostics_.error(at(path, 1 + static_cast<int>(std::count(text.data(), text.data() + root, '\n'))),
                           "<sdf> needs the attribute 'version'", "<sdf version=\"1.4\">");
    else
        diagnostics_.error(at(path, 0), "this file could not be read",
                           why.empty() ? std::string() : std::string(why.front()));
}

void SdfParser::report_unknown(const Location& where, const std::string& message) {
    const std::string element(between(message, "Element[", "]")), parent(between(message, "element[", "]"));
    const auto known = children_of(parent);
    const auto near = nearest(element, known);
    if (near.empty() && parent == "sdf") return;  // that the world is missing is said once
    for (const auto& d : diagnostics_.all())      // the library says it twice of includes
        if (d.where.file == where.file && d.where.line == where.line &&
            d.message.find(fmt::format("<{}> is not known in <{}>", element, parent)) == 0)
            return;
    diagnostics_.warning(where, fmt::format("<{}> is not known in <{}> and has no effect", element, parent),
                         near.empty() ? std::string() : fmt::format("did you mean <{}>?", near));
}

void SdfParser::report_reason(const Location& where, const std::string& element, std::string_view reason) {
    const std::string hint = expected(element);
    if (const auto wanted = between(reason, "must have ", " values"); !wanted.empty()) {
        diagnostics_.error(where,
                           fmt::format("<{}> has {} numbers instead of {}", element,
                                       between(reason, "but ", " were"), wanted),
                           hint);
    } else if (const auto value = between(reason, "Unable to set value [", "]"); !value.empty()) {
        diagnostics_.error(
            where,
            fmt::format("<{}> cannot be '{}'", element, value.substr(0, value.find_last_not_of(' ') + 1)),
            hint.empty() ? "a number is expected here, with a point and without a unit" : hint);
    } else if (reason.find("finite") != std::string_view::npos) {
        diagnostics_.error(where, fmt::format("<{}> holds a number that is not finite", element), hint);
    } else if (reason.find("nvalid boolean") != std::string_view::npos) {
        diagnostics_.error(where, fmt::format("<{}> must be true or false", element));
    } else if (reason.find("mpty string") != std::string_view::npos) {
        diagnostics_.error(where, fmt::format("<{}> is empty", element), hint);
    } else {
        diagnostics_.error(where, fmt::format("<{}> could not be read", element), std::string(reason));
    }
}

/// The names of all elements that may stand in an element of this name, wherever it stands.
std::vector<std::string> SdfParser::children_of(const std::string& element) const {
    std::set<std::string> names;
    std::deque<sdf::ElementPtr> open{document_->Root()};
    for (; !open.empty(); open.pop_front())
        for (unsigned i = 0; i < open.front()->GetElementDescriptionCount(); ++i) {
            const auto description = open.front()->GetElementDescription(i);
            if (open.front()->GetName() == element) names.insert(description->GetName());
            open.push_back(description);
        }
    return {names.begin(), names.end()};
}

Location SdfParser::at(const std::string& file, int line, const std::string& element) {
    auto& known = files_[file];
    if (!known) known = std::make_shared<SourceFile>(SourceFile{file, read_text(file).value_or("")});
    return {known, line, line > 0 ? column_of("<" + element, known->text, line) : 0};
}

Location SdfParser::at(const sdf::ElementPtr& e) {
    if (!e->LineNumber() && e->GetParent()) {  // what is in a plugin: it has no line
        const Location parent = at(e->GetParent());
        const auto begin = line_begin(parent.file->text, parent.line);
        const auto here = parent.file->text.find("<" + e->GetName(), begin);
        return here == std::string::npos ? parent : location_of(parent.file, here);
    }
    return at(e->FilePath(), e->LineNumber().value_or(0), e->GetName());
}

}  // namespace forage::bug
