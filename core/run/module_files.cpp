#include "core/run/module_files.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/sequence.h"
#include "core/run/result_files.h"

namespace forage {

namespace fs = std::filesystem;

void ModuleFiles::begin(const std::vector<std::unique_ptr<Observer>>& observers) {
    opening_ = true;
    taken_ = {"run.json"};
    for (const auto& o : observers)
        for (const auto& name : o->file_names()) taken_.insert(name);
}

std::ostream& ModuleFiles::open(const std::string& process, const std::string& name) {
    if (!opening_) throw std::logic_error("a module opens its files in start()");
    const std::string whole = file_name(process + "_" + name);
    if (!taken_.insert(whole).second)
        throw std::runtime_error(fmt::format("the run already writes a file '{}'", whole));
    files_.push_back(std::make_unique<File>());
    files_.back()->name = whole, files_.back()->path = directory_ + "/" + whole;
    return files_.back()->text;
}

void ModuleFiles::write(File& f) const {
    if (!directory_.empty()) {
        const std::string growing = partial(f.path);
        if (!f.file) {
            // A run that was stopped by a signal has renamed the file.
            if (f.kept && !fs::exists(growing)) fs::rename(f.path, growing);
            f.file.emplace(growing, f.kept);
        }
        f.file->buffer() += f.text.view();
        f.file->flush();
    }
    f.text.str({});
}

void ModuleFiles::after_cycle(RunView&) {
    if (files_.empty()) return;
    const auto now = std::chrono::steady_clock::now();
    const bool all = now - written_ >= std::chrono::seconds(1);
    if (all) written_ = now;
    for (const auto& f : files_)
        if (all || !f->file || f->text.view().size() >= 1 << 16) write(*f);
}

std::vector<std::string> ModuleFiles::file_names() const {
    return collected(files_, [](const auto& f) { return f->name; });
}

void ModuleFiles::finish(RunView&, ResultFiles& files) {
    if (directory_.empty()) return;
    for (const auto& f : files_)
        files.attempt([&] {
            write(*f);
            f->file->close();
            forage::finish(f->path);
            files.add(f->name);
        });
}

void ModuleFiles::checkpoint(Archive& archive) {
    archive.same(file_names(), "the files of modules");
    for (const auto& f : files_) {
        const std::string growing = partial(f->path);
        std::uint64_t length = 0;
        if (!archive.loading()) {
            write(*f);
            if (f->file) flush_to_disk(growing), length = f->file->written();
        }
        archive(length);
        if (!archive.loading()) continue;
        f->text.str({});
        f->kept = length;
        if (directory_.empty()) continue;
        std::error_code missing;
        const auto size = fs::file_size(fs::exists(growing) ? growing : f->path, missing);
        if (missing || size < length)
            throw observe::ShortFile(
                fmt::format("the file '{}' of a module should have {} bytes at least", f->path, length));
    }
}

}  // namespace forage
