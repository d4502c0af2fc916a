#include "core/observe/npz.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/observe/zip_file.h"

namespace forage::observe {

void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays) {
    std::vector<ZipEntry> entries;
    for (const auto& [name, file] : arrays) entries.push_back({name + ".npy", file});
    write_zip(path, entries, false);
}

void extract_npz(const std::string& path, const std::string& name, const std::string& npy) {
    const ZipFile archive(path);
    const auto found = std::ranges::find(archive.entries(), name + ".npy", &ZipFile::Entry::name);
    if (found == archive.entries().end())
        throw std::runtime_error(fmt::format("'{}' has no array '{}'", path, name));
    archive.extract(*found, npy);
}

}  // namespace forage::observe
