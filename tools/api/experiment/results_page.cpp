#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/table.h"
#include "core/run/result_names.h"
#include "core/run/run_json.h"
#include "core/xml/source_tree.h"
#include "tools/api/experiment/results.h"
#include "tools/plot/canvas.h"

namespace forage {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_rows = 200, max_columns = 40, max_pictures = 500;

/// A file name as a relative URL.
std::string address(std::string_view name) {
    std::string out = "./";
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) || std::string_view("-._~/").find(c) != std::string_view::npos)
            out += c;
        else
            out += fmt::format("%{:02X}", byte);
    }
    return out;
}

std::string picture(const std::string& name) {
    const std::string at = address(name), text = xml::encoded(name);
    if (plot::format_of(name) == plot::Format::pdf)
        return fmt::format("<p><a href=\"{}\">{}</a></p>\n", at, text);
    return fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" loading=\"lazy\" "
        "alt=\"{1}\"></a><figcaption>{1}</figcaption></figure>\n",
        at, text);
}

/// A table as HTML: all rows of a small table, and the first rows of a larger one. Recordings and paths,
/// which are long, become a link.
std::string table(const fs::path& path) {
    const std::string name = path.filename().string();
    TableReader in(open_file(path.string()), path.string());
    std::string rows, first;
    std::size_t count = 0;
    for (; count <= max_rows && in.next(); ++count) {
        if (count == 0) first = in.row();
        rows += "<tr>";
        for (std::size_t i = 0; i < std::min(in.fields().size(), max_columns); ++i)
            rows += fmt::format("<{0}>{1}</{0}>", count == 0 ? "th" : "td", xml::encoded(in.fields()[i]));
        rows += "</tr>\n";
    }
    std::string out = fmt::format("<h3><a href=\"{}\">{}</a></h3>\n", address(name), xml::encoded(name));
    if (first.starts_with("cycle,") || is_of_trajectory(name)) return out;
    out += "<table>\n" + rows + "</table>\n";
    if (count > max_rows) out += fmt::format("<p>The first {} rows.</p>\n", max_rows);
    return out;
}

std::string settings(const std::string& directory) {
    const auto run = read_run_json(directory);
    if (!run) return {};
    std::string out = "<h2>What was run</h2>\n<table>\n";
    for (const auto& [key, value] : run->settings)
        out += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", xml::encoded(key), xml::encoded(value));
    return out + "</table>\n";
}

/// Whether a picture shows all runs of an experiment.
bool shows_all_runs(const fs::path& picture) {
    const std::string name = picture.filename().string();
    return name.starts_with("curve_") || name.starts_with("heat_") || name.starts_with("learning") ||
           name.starts_with("occupancy");
}

std::string results_page(const std::string& directory) {
    std::vector<fs::path> pictures, tables, others, folders;
    for (const auto& entry : fs::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_directory())
            folders.push_back(entry.path());
        else if (name == "index.html" || name == "run.json")
            continue;
        else if (plot::format_of(name))
            pictures.push_back(entry.path());
        else if (name.ends_with(".csv"))
            tables.push_back(entry.path());
        else
            others.push_back(entry.path());
    }
    for (auto* files : {&pictures, &tables, &others, &folders}) std::ranges::sort(*files);
    std::stable_partition(pictures.begin(), pictures.end(), shows_all_runs);
    const std::string title = xml::encoded(fs::weakly_canonical(directory).filename().string());
    std::string out = fmt::format(R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title>
<style>
body {{ font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 1200px; padding: 0 1em; color: #222; background: #fff; }}
figure {{ margin: 0 0 2em; }} img {{ max-width: 100%; border: 1px solid #ddd; }} figcaption {{ color: #666; }}
table {{ border-collapse: collapse; font-size: 13px; }} th, td {{ border: 1px solid #ddd; padding: 2px 8px; text-align: left; }}
</style></head><body>
<h1>{0}</h1>
)",
                                  title);
    for (const auto& p : pictures) out += picture(p.filename().string());
    out += settings(directory);
    if (!tables.empty()) out += "<h2>Tables</h2>\n";
    for (const auto& t : tables) out += table(t);
    if (!others.empty() || !folders.empty()) out += "<h2>Other files</h2>\n<ul>\n";
    for (const auto* list : {&others, &folders})
        for (const auto& f : *list) {
            const std::string name = f.filename().string();
            out += fmt::format("<li><a href=\"{}\">{}</a></li>\n", address(name), xml::encoded(name));
        }
    if (!others.empty() || !folders.empty()) out += "</ul>\n";
    const auto below = pictures_below(directory);
    if (!below.empty()) out += fmt::format("<h2>Pictures of the runs</h2>\n");
    for (std::size_t i = 0; i < std::min(below.size(), max_pictures); ++i) out += picture(below[i]);
    if (below.size() > max_pictures)
        out += fmt::format("<p>The first {} of {} pictures.</p>\n", max_pictures, below.size());
    return out + "</body></html>\n";
}

/// The folders in runs/ of an experiment that its table does not name; none in other directories.
std::set<fs::path> leftover_runs(const fs::path& directory) {
    std::set<fs::path> out;
    if (!holds_experiment(directory.string()) || !fs::is_directory(directory / "runs")) return out;
    for (const auto& entry : fs::directory_iterator(directory / "runs")) out.insert(entry.path());
    for (const auto& row : read_run_table(directory.string()).rows) out.erase(directory / "runs" / row.run);
    return out;
}

}  // namespace

std::vector<std::string> pictures_below(const std::string& directory) {
    std::vector<std::string> out;
    std::set<fs::path> leftover = leftover_runs(directory);
    for (auto entry = fs::recursive_directory_iterator(directory);
         entry != fs::recursive_directory_iterator(); ++entry) {
        const fs::path& path = entry->path();
        if (leftover.contains(path))
            entry.disable_recursion_pending();
        else if (entry->is_directory())
            leftover.merge(leftover_runs(path));
        else if (plot::format_of(path.filename().string()) && path.parent_path() != fs::path(directory))
            out.push_back(path.lexically_relative(directory).string());
    }
    std::ranges::sort(out);
    return out;
}

std::string write_page(const std::string& directory, Diagnostics& diagnostics) {
    if (holds_experiment(directory)) {
        Results results = open_results(directory);
        if (!usual_plots(*results.experiment, directory).empty())
            draw(results, {}, directory, plot::Format::png, diagnostics);
    }
    const std::string file = (fs::path(directory) / "index.html").string();
    write_result(file, results_page(directory));
    return file;
}

}  // namespace forage
