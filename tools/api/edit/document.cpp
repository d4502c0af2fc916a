#include "tools/api/edit/document.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/base/output_files.h"
#include "core/base/separated.h"
#include "core/base/text_difference.h"
#include "core/base/text_file.h"
#include "core/equations/declared_types.h"
#include "core/model/edit.h"
#include "core/model/merge.h"
#include "core/model/validate.h"
#include "core/xml/patch.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/api/open/sources.h"

namespace forage {
namespace {

/// Checks a system, with the types that it declares itself.
void check(const model::System& system, Registry types, Diagnostics& out, Environment* environment) {
    equations::add_types(system, types, out);
    model::validate(system, types, out, environment);
}

namespace fs = std::filesystem;

/// The name by which messages call a text without a file.
std::string shown(const std::string& path) { return path.empty() ? "untitled.iqr" : path; }

}  // namespace

Document Document::open(const std::string& path, bool lenient) {
    Document out = unsaved(path, read_input_file(path), lenient);
    out.saved_ = out.text_, out.saved_system_ = out.system_;
    out.stamp_ = stamp_of(path);
    return out;
}

Document Document::open_text(const std::string& path, bool lenient) {
    Document out;
    out.path_ = path;
    out.lenient_ = lenient;
    out.system_.id = "system";
    out.read(read_input_file(path), Accept::any);
    out.saved_ = out.text_, out.saved_system_ = out.system_;
    out.stamp_ = stamp_of(path);
    return out;
}

Document Document::unsaved(std::string path, std::string text, bool lenient) {
    Document out;
    out.path_ = std::move(path);
    out.lenient_ = lenient;
    out.read(std::move(text));
    out.saved_system_ = out.system_;
    if (!out.path_.empty() && fs::exists(out.path_)) {
        out.saved_ = read_input_file(out.path_);
        out.stamp_ = stamp_of(out.path_);
    }
    return out;
}

Document Document::create(const std::string& name, const std::string& content) {
    model::System system;
    system.id = "system", system.name = name;
    Document out = unsaved({}, content.empty() ? xml::write_system(system) : content);
    if (!content.empty()) out.edit([&](model::System& copy) { copy.name = name; });
    out.saved_ = out.text_;  // there is nothing to lose
    return out;
}

Document::Stamp Document::stamp_of(const std::string& path) {
    std::error_code failed;
    const Stamp out{fs::last_write_time(path, failed), fs::file_size(path, failed)};
    return failed ? Stamp() : out;
}

void Document::read(std::string text, Accept accept) {
    Diagnostics diagnostics;
    diagnostics.lenient = lenient_;
    auto system = xml::parse_system(shown(path_), text, diagnostics);
    if (!system && accept == Accept::system) throw InputError(std::move(diagnostics));
    readable_ = system.has_value();
    if (system) system_ = *std::move(system);
    diagnostics_ = std::move(diagnostics);
    text_ = std::move(text);
}

std::vector<Document::Problem> Document::problems(const Registry& registry, Environment* environment) const {
    Diagnostics all = diagnostics_;
    if (readable_) check(system_, registry, all, environment);
    return located(all);
}

std::vector<Document::Problem> Document::located(const Diagnostics& diagnostics) const {
    std::vector<Problem> out;
    if (diagnostics.all().empty()) return out;
    // Only a text that is well-formed has a tree.
    const auto root = readable_ ? xml::scan(text_) : xml::SourceElement();
    std::vector<std::size_t> line_starts{0};
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') line_starts.push_back(i + 1);
    for (const Diagnostic& d : diagnostics.all()) {
        const auto line = static_cast<std::size_t>(d.where.line);
        const bool here = readable_ && d.where.file && d.where.file->path == shown(path_) && line >= 1 &&
                          line <= line_starts.size();
        const auto column = static_cast<std::size_t>(std::max(d.where.column, 1)) - 1;
        const std::size_t at = here ? line_starts[line - 1] + column : 0;
        out.push_back({d, here ? xml::item_around(root, {at, at + 1}) : std::string()});
    }
    return out;
}

bool Document::edit(const Edit& change) {
    if (!readable_)
        throw InputError("the text of the system has mistakes that hide its meaning",
                         "correct them in the XML of the system first");
    model::System wanted = system_;
    change(wanted);
    auto patch = xml::patch(shown(path_), text_, system_, wanted, lenient_);
    if (!patch.system) throw InputError(std::move(patch.diagnostics));
    if (patch.text == text_) return false;
    text_ = std::move(patch.text);
    system_ = *std::move(patch.system);
    diagnostics_ = std::move(patch.diagnostics);
    return true;
}

bool Document::replace(std::string text, Accept accept) {
    if (text == text_) return false;
    read(std::move(text), accept);
    return true;
}

bool Document::replace_text(std::string text) { return replace(std::move(text), Accept::system); }

bool Document::write_text(std::string text) { return replace(std::move(text), Accept::any); }

xml::Span Document::place_of(std::string_view id) const {
    if (id == system_.id) return {0, text_.size()};
    const auto place = readable_ ? xml::find_item(xml::scan(text_), id) : std::nullopt;
    if (!place)
        throw InputError(fmt::format("there is no item with the id '{}' in this file", id),
                         readable_ ? "" : "correct the mistakes in the XML of the system first");
    return *place;
}

std::string Document::item_text(std::string_view id) const { return std::string(place_of(id).of(text_)); }

bool Document::replace_item_text(std::string_view id, const std::string& text) {
    const auto place = place_of(id);
    return replace_text(text_.substr(0, place.begin) + text + text_.substr(place.end));
}

Diagnostics Document::check_item_text(std::string_view id, const std::string& text, const Registry& registry,
                                      Environment* environment) const {
    const auto place = place_of(id);
    const std::string before = text_.substr(0, place.begin);
    Diagnostics all;
    all.lenient = lenient_;
    const auto system = xml::parse_system(shown(path_), before + text + text_.substr(place.end), all);
    if (system) check(*system, registry, all, environment);
    std::set<std::string> known;
    for (const auto& p : problems(registry, environment)) known.insert(p.diagnostic.message);

    const auto lines = [](std::string_view t) { return static_cast<int>(std::ranges::count(t, '\n')); };
    const auto last_line = [](std::string_view t) {
        return static_cast<int>(t.size() - (t.rfind('\n') + 1));
    };
    const int first = lines(before) + 1, last = first + lines(text);
    const int begin = last_line(before);  // bytes before the text on its first line
    const int end = last_line(text) + (first == last ? begin : 0);
    Diagnostics out;
    for (Diagnostic d : all.all()) {
        const auto [line, column] = std::pair(d.where.line, d.where.column);
        const bool here = d.where.file && d.where.file->path == shown(path_) && line >= first &&
                          line <= last && (line > first || column > begin) &&
                          (line < last || column <= end + 1);
        if (here) {
            d.where.line -= first - 1;
            if (line == first) d.where.column -= begin;
        } else if (known.contains(d.message)) {
            continue;
        } else {
            d.where.line = d.where.column = 0;
        }
        out.add(std::move(d));
    }
    return out;
}

void Document::save(const std::string& path, const Registry& registry, bool overwrite,
                    const std::vector<std::string*>& earlier) {
    const std::string& to = path.empty() ? path_ : path;
    if (to.empty()) throw InputError("the system has no file yet", "choose a name that ends with .iqr");
    std::error_code ignored;
    const bool same = !path_.empty() && (to == path_ || fs::equivalent(to, path_, ignored));
    if (!overwrite && same && changed_outside())
        throw InputError(fmt::format("'{}' was changed outside since it was read", to),
                         "reload it, merge both changes, or overwrite it");
    if (!overwrite && !same && fs::exists(to))
        throw FileExists(fmt::format("'{}' exists", to), "overwrite it, or choose another name");
    // The names of files in a text lead to the same files from the new place.
    const auto moved = [&](const std::string& text) {
        Diagnostics unread;
        unread.lenient = lenient_;
        const auto system = xml::parse_system(path_, text, unread);
        if (!system) return text;
        model::System there = *system;
        model::move_files(there, path_, to, registry);
        return xml::same_content(there, *system) ? text : xml::patch(to, text, *system, there, lenient_).text;
    };
    std::string text = same || path_.empty() ? text_ : moved(text_);
    write_file(to, text);  // a failure leaves the document as it was
    if (text != text_)
        for (std::string* other : earlier) *other = moved(*other);
    text_ = std::move(text);
    const bool renamed = to != path_;
    path_ = to;
    saved_ = text_;
    stamp_ = stamp_of(path_);
    if (renamed) read(text_, Accept::any);  // messages name the file, and links begin in its folder
    saved_system_ = system_;
}

bool Document::changed_outside() const {
    if (path_.empty()) return false;
    const Stamp now = stamp_of(path_);
    if (now == stamp_) return false;
    try {
        if (read_file(path_) != saved_) return true;
    } catch (const FileError&) {
        return true;
    }
    stamp_ = now;
    return false;
}

bool Document::reload(Keep keep) {
    if (path_.empty()) throw InputError("the system has no file yet", "save it first");
    const Stamp now = stamp_of(path_);
    std::string theirs = read_input_file(path_);
    const bool changed = [&] {
        if (keep == Keep::mine) return false;
        if (keep == Keep::theirs) {
            const bool step = write_text(theirs);
            saved_system_ = system_;
            return step;
        }
        Diagnostics diagnostics;
        diagnostics.lenient = lenient_;
        const auto base = xml::parse_system(path_, saved_, diagnostics);
        const auto there = xml::parse_system(path_, theirs, diagnostics);
        if (!base || !there) throw InputError(std::move(diagnostics));
        if (!readable_)
            throw InputError("a text with mistakes that hide its meaning cannot be merged",
                             "keep yours, or take the text of the file");
        const auto merged = model::merge(*base, system_, *there);
        if (!merged.conflicts.empty())
            throw InputError(fmt::format("both have changed {}", separated(merged.conflicts, ", ")),
                             "keep yours, or take the text of the file");
        auto patch = xml::patch(path_, theirs, *there, merged.system, lenient_);
        if (!patch.system) throw InputError(std::move(patch.diagnostics));
        saved_system_ = *there;
        return replace_text(std::move(patch.text));
    }();
    saved_ = std::move(theirs);
    stamp_ = now;
    return changed;
}

void Document::checkpoint(Archive& archive) {
    if (!archive.loading() && !path_.empty()) {
        std::string path = fs::absolute(path_).string();
        archive(path);
    } else {
        archive(path_);
    }
    archive(text_, saved_, lenient_);
    if (!archive.loading()) return;
    Diagnostics ignored;
    if (auto saved = xml::parse_system(shown(path_), saved_, ignored)) saved_system_ = *std::move(saved);
    std::string text = std::move(text_);
    read(std::move(text), Accept::any);
    stamp_ = {};
}

std::string Document::difference() const {
    return unified_difference(saved_, text_, shown(path_) + " (saved)", shown(path_));
}

}  // namespace forage
