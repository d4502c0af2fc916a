#include "core/xml/patch.h"

#include <map>
#include <vector>

#include "core/base/alignment.h"
#include "core/base/sequence.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"

namespace forage::xml {
namespace {

using Elements = std::vector<SourceElement>;

bool is_item(std::string_view name) { return name == "Process" || name == "Group" || name == "Connection"; }
/// Whether the element is a comment on a page, or another part of the diagram that stands in an XML comment.
bool is_canvas_part(std::string_view name) { return name.starts_with("forage:"); }

/// The elements that take the same place in their parent: those of one name, or alternatives.
std::string place_of(const SourceElement& e) {
    if (e.name == "XRefHolder") return "XRefHolder " + std::string(e.value("name"));
    if (e.name == "All" || e.name == "Region" || e.name == "List") return "population";
    for (const std::string_view kind : {"Topology", "Pattern", "Arb", "Fun"})
        if (e.name.starts_with(kind) && e.name != kind && e.name != "Arborization") return std::string(kind);
    return std::string(e.name);
}

/// Whether the first attribute that the writer gives an element is its id or its name (of a state, too).
bool has_own_name(std::string_view name) {
    return is_item(name) || is_canvas_part(name) || name == "Parameter" || name == "XRef" ||
           name == "Constant" || name == "Initial" || name == "NeuronType" || name == "SynapseType" ||
           name == "State";
}

/// What two elements of the writer share that are the same one before and after a change. Elements without a
/// name of their own are the same when their texts are.
std::string key_of(std::string_view text, const SourceElement& e) {
    if (has_own_name(e.name)) return std::string(e.name) + " " + std::string(e.attributes.front().value);
    if (e.name == "Point" || e.name == "Tuple") return std::string(e.whole.of(text));
    return place_of(e);
}

/// Carries the difference of two texts of the writer over to the text of an author.
class Patcher {
  public:
    Patcher(std::string_view text, std::string_view before, std::string_view after, Extent extent)
        : text_(text), before_(before), after_(after), extent_(extent) {}

    std::string run() {
        const auto mine = scan(text_), old = scan(before_), wanted = scan(after_);
        layout_ = layout_of(text_, mine);
        element(mine, old, wanted);
        return edits_.applied(text_);
    }

  private:
    bool same(const SourceElement& old, const SourceElement& wanted) const {
        return old.whole.of(before_) == wanted.whole.of(after_);
    }

    void element(const SourceElement& mine, const SourceElement& old, const SourceElement& wanted) {
        if (same(old, wanted)) return;
        attributes(mine, old, wanted);
        if (!old.children.empty() || !wanted.children.empty()) return children(mine, old, wanted);
        const auto text = wanted.content.of(after_);
        if (old.content.of(before_) == text) return;
        if (mine.closed)
            edits_.replace(mine.content, std::string(text));
        else
            edits_.replace({mine.tag.end - 2, mine.tag.end},
                           ">" + std::string(text) + "</" + std::string(mine.name) + ">");
    }

    void attributes(const SourceElement& mine, const SourceElement& old, const SourceElement& wanted) {
        const SourceAttribute* previous = nullptr;
        for (const auto& a : wanted.attributes) {
            const auto* here = mine.attribute(a.name);
            const auto* was = old.attribute(a.name);
            if (!was || was->value != a.value) {
                if (here)
                    edits_.replace(here->inside, std::string(a.value));
                else
                    insert_attribute(mine, previous, a);
            }
            if (here) previous = here;
        }
        for (const auto& a : old.attributes)
            if (const auto* here = mine.attribute(a.name); here && !wanted.attribute(a.name)) {
                const auto before = text_.find_last_not_of(" \t\r\n", here->whole.begin - 1);
                edits_.replace({before + 1, here->whole.end}, {});
            }
    }
    void insert_attribute(const SourceElement& mine, const SourceAttribute* previous,
                          const SourceAttribute& a) {
        const auto name_end = static_cast<std::size_t>(mine.name.data() + mine.name.size() - text_.data());
        const std::size_t at = previous ? previous->whole.end : name_end;
        std::string gap = " ";
        if (previous) {  // on a line of its own when the others are
            const auto before = text_.find_last_not_of(" \t\r\n", previous->whole.begin - 1) + 1;
            gap = text_.substr(before, previous->whole.begin - before);
        }
        edits_.insert(at, gap + std::string(a.name) + "=\"" + std::string(a.value) + "\"");
    }

    void children(const SourceElement& mine, const SourceElement& old, const SourceElement& wanted) {
        const auto keys = [](std::string_view text, const Elements& all) {
            return collected(all, [&](const auto& e) { return key_of(text, e); });
        };
        auto pairs = aligned(keys(before_, old.children), keys(after_, wanted.children));
        join_gaps(pairs, old.children, wanted.children);

        const auto places = counterparts(mine.children, old.children);
        std::map<std::string, bool> afresh;  // places whose elements are all rewritten
        std::vector<char> stays(mine.children.size(), true);
        std::vector<const SourceElement*> mine_of(wanted.children.size());
        const auto differs = [&](const SourceElement& e) { afresh[place_of(e)] = true; };
        for (const auto& [i, j] : pairs) {
            const auto* was = i < 0 ? nullptr : &old.children[static_cast<std::size_t>(i)];
            const auto* is = j < 0 ? nullptr : &wanted.children[static_cast<std::size_t>(j)];
            const int here = was ? places.of_old[static_cast<std::size_t>(i)] : -1;
            if (was && is && same(*was, *is)) {
                if (here >= 0)
                    mine_of[static_cast<std::size_t>(j)] = &mine.children[static_cast<std::size_t>(here)];
            } else if (here < 0) {
                if (was || places.unclear.contains(place_of(*is))) differs(was ? *was : *is);
            } else if (is) {
                const auto& e = mine.children[static_cast<std::size_t>(here)];
                mine_of[static_cast<std::size_t>(j)] = &e;
                const bool whole = extent_ == Extent::items && (e.name == "Group" || e.name == "Connection");
                if (e.name == is->name && !whole)
                    element(e, *was, *is);
                else
                    replace(e, *is);
            } else {
                stays[static_cast<std::size_t>(here)] = false;
                cut(mine, static_cast<std::size_t>(here));
            }
        }
        for (std::size_t k = 0; k < mine.children.size(); ++k)
            if (stays[k] && afresh.contains(place_of(mine.children[k]))) cut(mine, k);
        insert_new(mine, wanted, mine_of, afresh, pairs);
    }

    /// Joins an element that vanishes with one that appears at the same place: it is a change of it.
    void join_gaps(std::vector<std::pair<int, int>>& pairs, const Elements& old,
                   const Elements& wanted) const {
        std::vector<std::pair<int, int>> out;
        for (auto it = pairs.begin(); it != pairs.end();) {
            if (it->first >= 0 && it->second >= 0) {
                out.push_back(*it++);
                continue;
            }
            std::vector<int> gone, come;
            for (; it != pairs.end() && (it->first < 0 || it->second < 0); ++it)
                it->first >= 0 ? gone.push_back(it->first) : come.push_back(it->second);
            std::size_t from = 0;
            for (const int j : come) {
                const auto& e = wanted[static_cast<std::size_t>(j)];
                std::size_t g = from;
                while (g < gone.size() && (has_own_name(e.name) ||
                                           place_of(old[static_cast<std::size_t>(gone[g])]) != place_of(e)))
                    ++g;
                if (g < gone.size()) {
                    for (; from < g; ++from) out.emplace_back(gone[from], -1);
                    out.emplace_back(gone[from++], j);
                } else {
                    out.emplace_back(-1, j);
                }
            }
            for (; from < gone.size(); ++from) out.emplace_back(gone[from], -1);
        }
        pairs = std::move(out);
    }

    struct Counterparts {
        std::vector<int> of_old;  ///< the author's element for each of the writer's; -1 when that is unclear
        std::map<std::string, bool> unclear;  ///< places with another number of elements
    };
    static Counterparts counterparts(const Elements& mine, const Elements& old) {
        std::map<std::string, std::pair<std::vector<int>, std::vector<int>>> by_place;
        for (std::size_t i = 0; i < mine.size(); ++i)
            by_place[place_of(mine[i])].first.push_back(static_cast<int>(i));
        for (std::size_t i = 0; i < old.size(); ++i)
            by_place[place_of(old[i])].second.push_back(static_cast<int>(i));
        Counterparts out{std::vector<int>(old.size(), -1), {}};
        for (const auto& [place, both] : by_place) {
            if (both.first.size() != both.second.size())
                out.unclear[place] = true;
            else
                for (std::size_t k = 0; k < both.first.size(); ++k)
                    out.of_old[static_cast<std::size_t>(both.second[k])] = both.first[k];
        }
        return out;
    }

    std::string kept_comments(const SourceElement& e) const {
        std::string out;
        for (const Span& c : e.comments) out += std::string(c.of(text_)) + " ";
        for (const auto& child : e.children) out += kept_comments(child);
        return out;
    }

    /// Replaces an element by one of another form. The comments in it stay before it.
    void replace(const SourceElement& e, const SourceElement& wanted) {
        const auto start = line_start(text_, e.whole.begin);
        edits_.replace(
            e.whole, (is_item(e.name) ? std::string() : kept_comments(e)) +
                         rendered(after_, wanted, start.indentation, start.alone ? layout_ : Layout{"", ""}));
    }

    /// The comments between an element and the one before it. One at the end of a line is about what stands
    /// before it there.
    static std::vector<Span> comments_before(std::string_view text, const SourceElement& parent,
                                             std::size_t child) {
        const std::size_t from = child == 0 ? parent.content.begin : parent.children[child - 1].whole.end;
        const std::size_t to = parent.children[child].whole.begin;
        const auto one_line = [&](std::size_t begin, std::size_t end) {
            return text.substr(begin, end - begin).find('\n') == text.npos;
        };
        std::vector<Span> out;
        for (const Span& c : parent.comments)
            if (c.begin >= from && c.end <= to && (!one_line(from, c.begin) || one_line(c.end, to)))
                out.push_back(c);
        return out;
    }

    void cut(const SourceElement& parent, std::size_t child) {
        const auto& e = parent.children[child];
        Span span = e.whole;
        if (is_item(e.name)) {
            if (const auto comments = comments_before(text_, parent, child); !comments.empty())
                span.begin = comments.front().begin;
            edits_.cut(text_, span);
        } else if (auto comments = kept_comments(e); comments.empty()) {
            edits_.cut(text_, span);
        } else {
            comments.pop_back();
            edits_.replace(span, comments);
        }
    }

    void insert_new(const SourceElement& mine, const SourceElement& wanted,
                    std::vector<const SourceElement*>& mine_of, const std::map<std::string, bool>& afresh,
                    const std::vector<std::pair<int, int>>& pairs) {
        const SourceElement* anchor = nullptr;
        std::vector<Piece> pieces;
        const auto insert = [&] {
            if (!pieces.empty()) insert_into(edits_, text_, mine, anchor, layout_, pieces);
            pieces.clear();
        };
        std::vector<char> is_new(wanted.children.size(), false);
        for (const auto& [i, j] : pairs)
            if (i < 0) is_new[static_cast<std::size_t>(j)] = true;
        for (std::size_t j = 0; j < wanted.children.size(); ++j) {
            const auto& e = wanted.children[j];
            if (is_new[j] || afresh.contains(place_of(e))) {
                pieces.push_back(
                    {after_, &e, is_item(e.name) ? comments_before(after_, wanted, j) : std::vector<Span>()});
            } else if (mine_of[j] &&
                       (!anchor || mine_of[j]->whole.end > anchor->whole.end || !pieces.empty())) {
                insert();
                anchor = mine_of[j];
            }
        }
        insert();
    }

    std::string_view text_, before_, after_;
    Extent extent_;
    Layout layout_;
    TextEdits edits_;
};

/// The text of a system with all elements of its connections, also those that its file leaves out.
std::string in_full(model::System system) {
    for (auto& c : system.connections) c.terse = false;
    return write_system(system);
}

const SourceElement* item(const SourceElement& e, std::string_view id) {
    const bool is_comment = e.name == "forage:comment";
    if ((is_item(e.name) || is_comment || e.name == "System") && e.value("id") == id) return &e;
    for (const auto& child : e.children)
        if (is_item(child.name) || child.name == "forage:comment")
            if (const auto* found = item(child, id)) return found;
    return nullptr;
}

}  // namespace

std::string patched(const std::string& text, const model::System& before, const model::System& after,
                    Extent extent) {
    if (extent == Extent::all) return write_system(after);
    return Patcher(text, in_full(before), in_full(after), extent).run();
}

Patch patch(const std::string& path, const std::string& text, const model::System& before,
            const model::System& after, bool lenient) {
    Patch out;
    model::System wanted = after;  // as it will be read
    model::compute(wanted);
    for (const Extent extent : {Extent::least, Extent::items, Extent::all}) {
        out.extent = extent;
        out.text = patched(text, before, after, extent);
        out.diagnostics = {};
        out.diagnostics.lenient = lenient;
        out.system = parse_system(path, out.text, out.diagnostics);
        if (out.system && same_content(*out.system, wanted)) break;
    }
    return out;
}

bool same_content(const model::System& a, const model::System& b) {
    // Of a linked process, the file has only the link.
    const auto content = [](model::System s) {
        s.comments.clear();
        for (auto* types : {&s.neuron_types, &s.synapse_types})
            std::erase_if(*types, [](const model::TypeDeclaration& type) { return type.linked; });
        for (auto& p : s.processes) {
            if (p.linked()) p = model::Process(p.placeholder.front());
            p.comments.clear();
            for (auto& g : p.groups) g.comments.clear(), g.terse = false;
        }
        std::erase_if(s.connections, [](const model::Connection& c) { return c.linked; });
        for (auto& c : s.connections) {
            c.comments.clear(), c.terse = c.terse_synapse = false;
            c.synapse = model::synapse_of(c);
        }
        return s;
    };
    return content(a) == content(b);
}

std::optional<Span> find_item(const SourceElement& root, std::string_view id) {
    const auto* found = item(root, id);
    return found ? std::optional(found->whole) : std::nullopt;
}

std::string item_around(const SourceElement& root, Span part) {
    for (const auto& child : root.children)
        if (is_item(child.name) && child.whole.begin <= part.begin && part.end <= child.whole.end) {
            const auto inner = item_around(child, part);
            return inner.empty() ? std::string(child.value("id")) : inner;
        }
    return {};
}

}  // namespace forage::xml
