#include "core/run/experiment/parts.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/base/digest.h"
#include "core/base/number.h"
#include "core/base/output_files.h"
#include "core/run/experiment/result_json.h"

namespace forage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// "3-of-10" of "3-of-10_node1-4711.jsonl".
std::string part_of(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.substr(0, name.find('_'));
}

/// The files of parts, in the order of their names. With `only`, not those of the other parts of its
/// division.
std::vector<fs::path> part_files(const std::string& directory, const std::optional<Shard>& only) {
    std::vector<fs::path> out;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(directory + "/parts", none)) {
        if (entry.path().extension() != ".jsonl") continue;
        const std::string part = part_of(entry.path());
        const bool other = only && part != only->name() && part.ends_with(fmt::format("-of-{}", only->of));
        if (!other) out.push_back(entry.path());
    }
    std::ranges::sort(out);
    return out;
}

}  // namespace

std::string Shard::name() const { return fmt::format("{}-of-{}", number, of); }

std::optional<Shard> parse_shard(const std::string& text) {
    const auto slash = text.find('/');
    if (slash == std::string::npos) return std::nullopt;
    const auto number = parse_number<std::size_t>(text.substr(0, slash)),
               of = parse_number<std::size_t>(text.substr(slash + 1));
    if (!number || !of || *number < 1 || *number > *of) return std::nullopt;
    return Shard{*number, *of};
}

RunKeys::RunKeys(const RunPlan& plan, const model::Experiment& experiment) : plan_(plan) {
    PlannedRun run = plan[0];
    run.files.clear(), run.spec.input.settings = experiment.settings, run.spec.input.seed = 0;
    shared_ = key_of(run, experiment);
}

std::uint64_t RunKeys::operator[](std::size_t run) const {
    const std::size_t combination = plan_.combination(run);
    std::string text = digest(shared_) + plan_.files(combination);
    for (const auto& setting : plan_.settings(combination)) text += "\n" + setting.text;
    return fnv1a(fmt::format("{}\n{}", text, plan_.seed(run)));
}

void PartFile::create() {
    make_directory(directory_ + "/parts");
    char host[256] = "host";
    gethostname(host, sizeof host - 1);
    for (int i = 0; file_ < 0; ++i) {
        path_ = fmt::format("{}/parts/{}_{}-{}{}.jsonl", directory_, part_, file_name(host), getpid(),
                            i > 0 ? fmt::format("-{}", i) : "");
        file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
        if (file_ < 0 && errno != EEXIST)
            throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
    }
}

PartFile::~PartFile() {
    if (file_ < 0) return;
    fsync(file_);
    close(file_);
}

void PartFile::add(const std::string& run, std::uint64_t key, const RunResult& result,
                   const std::string& trials) {
    if (file_ < 0) create();
    const double at = now();
    Json json;
    json["key"] = fmt::format("{:016x}", key), json["run"] = run;
    json["at"] = static_cast<std::uint64_t>(at * 1000);  // ms since 1970
    if (!trials.empty()) json["trials"] = trials;
    json["result"] = json_of(result);
    const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    ssize_t written;
    do written = write(file_, line.data(), line.size());
    while (written < 0 && errno == EINTR);
    bool flushed = true;
    if (at - flushed_ > 1) flushed = fdatasync(file_) == 0, flushed_ = at;
    if (written != std::ssize(line) || !flushed)
        throw std::runtime_error(
            fmt::format("cannot write '{}': {}", path_,
                        written < 0 || !flushed ? std::strerror(errno) : "the disk is full"));
}

std::size_t PartResults::finished() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(results, [](const auto& r) { return r && r->failure.empty(); }));
}

std::size_t PartResults::failed() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(results, [](const auto& r) { return r && !r->failure.empty(); }));
}

PartResults read_parts(const std::string& directory, const RunPlan& plan, const model::Experiment& experiment,
                       const std::optional<Shard>& only) {
    PartResults out;
    out.results.resize(plan.size());
    out.lines.resize(plan.size());
    for (const auto& file : part_files(directory, only)) out.files.push_back(file.string());
    if (out.files.empty()) return out;
    const RunKeys keys(plan, experiment);
    std::vector<std::pair<std::uint64_t, std::size_t>> runs;  // runs with equal input have equal keys
    runs.reserve(plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i) runs.emplace_back(keys[i], i);
    std::ranges::sort(runs);
    std::vector<std::uint64_t> times;  // ms
    for (std::uint32_t file = 0; file < out.files.size(); ++file) {
        std::ifstream in(out.files[file], std::ios::binary);
        std::string line;
        for (std::uint64_t at = 0; std::getline(in, line); at += line.size() + 1) {
            if (in.eof()) break;  // a line without its end was cut off by a kill
            try {
                const auto json = Json::parse(line);
                const auto text = json.at("key").get<std::string>();
                const std::uint64_t key = std::stoull(text, nullptr, 16);
                RunResult result = result_of(json.at("result"));
                if (result.failure.empty() && result.measures.size() != experiment.measures.size())
                    throw std::invalid_argument("measures");
                times.push_back(json.at("at").get<std::uint64_t>());
                auto run = std::ranges::lower_bound(runs, std::pair(key, std::size_t{0}));
                for (; run != runs.end() && run->first == key; ++run)
                    if (auto& kept = out.results[run->second]; !kept || !kept->failure.empty())
                        kept = result, out.lines[run->second] = {file, at};
            } catch (const std::exception&) {
                ++out.damaged;
            }
        }
    }
    if (times.empty()) return out;
    const std::uint64_t newest = *std::ranges::max_element(times), minute = 60'000;
    std::uint64_t oldest = newest, recent = 0;
    for (const auto t : times)
        if (t + minute >= newest) oldest = std::min(oldest, t), ++recent;
    out.newest = static_cast<double>(newest) / 1000;
    if (newest > oldest)
        out.rate = static_cast<double>(recent - 1) * 1000 / static_cast<double>(newest - oldest);
    return out;
}

std::vector<std::string> read_trials(const PartResults& parts, std::span<const PartResults::Line> lines) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].file != PartResults::no_file) order.push_back(i);
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        return std::pair(lines[a].file, lines[a].at) < std::pair(lines[b].file, lines[b].at);
    });
    std::vector<std::string> out(lines.size());
    std::ifstream in;
    std::uint32_t open = PartResults::no_file;
    for (const std::size_t i : order) {
        const std::string& path = parts.files[lines[i].file];
        if (lines[i].file != open) in = std::ifstream(path, std::ios::binary), open = lines[i].file;
        std::string line;
        in.seekg(static_cast<std::streamoff>(lines[i].at));
        if (!std::getline(in, line)) throw std::runtime_error(fmt::format("cannot read '{}'", path));
        out[i] = Json::parse(line).value("trials", "");
    }
    return out;
}

void forget_parts(const std::string& directory, const std::optional<Shard>& only) {
    std::error_code ignored;
    for (const auto& file : part_files(directory, {}))
        if (!only || part_of(file) == only->name()) fs::remove(file, ignored);
}

}  // namespace forage
