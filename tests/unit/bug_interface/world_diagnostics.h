// The diagnostics of world files.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <stdlib.h>

#include "tests/unit/bug_interface/worlds.h"

namespace forage::test {

/// A temporary directory; it is removed with its content.
struct Scratch {
    std::filesystem::path path;
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "forage_world_XXXXXX").string();
        REQUIRE(mkdtemp(name.data()));
        path = name;
    }
    ~Scratch() { std::filesystem::remove_all(path); }
    std::string write(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((path / file).parent_path());
        std::ofstream(path / file) << text;
        return (path / file).string();
    }
};

inline std::string models() { return (source_dir() / "systems/worlds/models").string(); }

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The text of the basic arena with the first `from` replaced by `to`.
inline std::string edited(const std::string& from, const std::string& to) {
    std::string text = text_of(source_dir() / "systems/worlds/basic_arena.world");
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The diagnostics of the world in `text`, one per line: "12: error: message | hint".
inline std::string diagnostics_of(const std::string& text, bool with_models = true) {
    const Scratch scratch;
    const std::string file = scratch.write("test.world", text);
    Diagnostics diagnostics;
    const auto world =
        bug::read_world(file, diagnostics, with_models ? std::vector{models()} : std::vector<std::string>{});
    CHECK(world.has_value() == (diagnostics.errors() == 0));
    if (world) bug::World::make(*world, {}, diagnostics);
    std::string out;
    for (const Diagnostic& d : diagnostics.all()) {
        if (d.where.file && d.where.line > 0) {
            CHECK(d.where.file->path == file);  // the file that the user edits
            out += std::to_string(d.where.line) + ": ";
        }
        out += (d.severity == Severity::error ? "error: " : "warning: ") + d.message;
        out += d.hint.empty() ? "\n" : " | " + d.hint + "\n";
    }
    return out;
}

/// The number of the first line of `text` that contains `what`.
inline std::string line_of(const std::string& text, const std::string& what) {
    const auto at = text.find(what);
    REQUIRE(at != std::string::npos);
    return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

}  // namespace forage::test
