#include "tools/api/edit/edit_files.h"

#include <exception>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/run/input_error.h"
#include "tools/api/open/sources.h"

namespace forage::editing {

EditFiles::~EditFiles() {
    for (auto it = before_.rbegin(); it != before_.rend(); ++it) try {
            if (it->second)
                write_file(it->first, *it->second);
            else
                std::filesystem::remove(it->first);
        } catch (const std::exception&) {  // the edit has failed already, and says why
            continue;
        }
}

void EditFiles::write(const std::string& path, const std::string& text, bool overwrite) {
    Diagnostics diagnostics;
    check_output(path, "part.iqrProcess", diagnostics);
    throw_errors(diagnostics);
    std::optional<std::string> before;
    if (std::filesystem::exists(path)) {
        if (!overwrite)
            throw FileExists(fmt::format("'{}' exists", path), "overwrite it, or choose another name");
        before = read_input_file(path);
    }
    write_file(path, text);
    before_.emplace_back(path, std::move(before));
}

}  // namespace forage::editing
