#include "core/run/result_files.h"

#include <exception>

#include "core/base/output_files.h"

namespace forage {

void ResultFiles::write(const std::string& name, const std::function<std::string()>& content) {
    const bool keep = name == kept_name_;
    if (directory_.empty() && !keep) return;
    attempt([&] {
        auto text = content();
        if (!directory_.empty()) write_result(path(name), text), add(name);
        if (keep) kept_ = std::move(text);
    });
}

void ResultFiles::attempt(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& e) {
        problems_.emplace_back(e.what());
    }
}

}  // namespace forage
