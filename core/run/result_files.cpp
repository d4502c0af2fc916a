#include "core/run/result_files.h"

#include <exception>

#include "core/base/output_files.h"

namespace forage {

void ResultFiles::write(const std::string& name, const std::function<std::string()>& content) {
    if (name == kept_name_) kept_ = content();
    if (directory_.empty()) return;
    attempt([&] { write_result(path(name), name == kept_name_ ? kept_ : content()); }, {name});
}

void ResultFiles::attempt(const std::function<void()>& action, const std::vector<std::string>& names) {
    try {
        action();
        names_.insert(names_.end(), names.begin(), names.end());
    } catch (const std::exception& e) {
        problems_.emplace_back(e.what());
    }
}

}  // namespace forage
