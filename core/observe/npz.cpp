#include "core/observe/npz.h"

#include <stdexcept>

#include <fmt/format.h>
#include <zip.h>

namespace forage::observe {

void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays) {
    int error = 0;
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
    bool fine = archive != nullptr;
    for (std::size_t i = 0; fine && i < arrays.size(); ++i) {
        const auto& [name, file] = arrays[i];
        zip_source_t* source = zip_source_file(archive, file.c_str(), 0, -1);
        const zip_int64_t index = zip_file_add(archive, (name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
        if (index < 0) zip_source_free(source);
        // No compression, so that the numbers can be mapped; no time, so that the same run gives the same
        // bytes.
        fine = index >= 0 &&
               zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0) == 0 &&
               zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, 0x21, 0) == 0;
    }
    if (fine && zip_close(archive) == 0) return;
    const std::string reason = archive ? zip_strerror(archive) : "it cannot be opened";
    if (archive) zip_discard(archive);
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
}

}  // namespace forage::observe
