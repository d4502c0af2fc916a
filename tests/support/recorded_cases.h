// The recorded cases of the original.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/support/golden.h"
#include "tests/support/paths.h"

namespace forage::test {

struct Case {
    std::string name;
    std::string status;  ///< ok, refused, original-crashes
    std::string note;
    std::filesystem::path path;  ///< the case's folder
};

/// The recorded traces that come with the project, unpacked (tests/data/README.md).
inline std::filesystem::path traces_dir() { return FORAGE_TRACES_DIR; }

/// The folders with the cases of a kind, such as "conformance" or "modules/moduleAL": one in the project's
/// archive, and one in the folder `golden` of shared_dir(), if it exists.
inline std::vector<std::filesystem::path> trace_folders(const std::string& kind) {
    std::vector<std::filesystem::path> out = {traces_dir() / kind};
    if (const auto more = shared_dir() / "golden" / kind; std::filesystem::exists(more)) out.push_back(more);
    return out;
}

/// The conformance cases in the order of their indices, each name once.
inline std::vector<Case> cases() {
    std::vector<Case> out;
    std::set<std::string, std::less<>> names;
    for (const auto& folder : trace_folders("conformance")) {
        Rows index(folder / "INDEX.tsv", '\t');
        for (std::vector<std::string_view> f; index.next(f);)
            if (f.size() >= 3 && names.emplace(f[0]).second)
                out.push_back({std::string(f[0]), std::string(f[1]), f.size() > 3 ? std::string(f[3]) : "",
                               folder / f[0]});
    }
    return out;
}

}  // namespace forage::test
