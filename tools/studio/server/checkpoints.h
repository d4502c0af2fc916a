// Checkpoints of a run, in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/archive.h"

namespace forage::studio {

/// The bytes of checkpoints, by cycle. They lie in blocks of one size. A checkpoint shares those that are
/// equal with the one before: most weights rest, and the list of trials only grows. A block that is freed
/// leaves a gap that the next one fills.
class Checkpoints {
  public:
    /// Keeps what `write` writes as the checkpoint of a cycle that has none.
    void add(std::uint64_t cycle, const std::function<void(Archive&)>& write) {
        const auto after = all_.upper_bound(cycle);
        Checkpoint made, none;
        const Checkpoint& before = after == all_.begin() ? none : std::prev(after)->second;
        made.blocks.reserve(before.blocks.size() + 1);
        Block filling{};
        Archive archive([&](std::string_view bytes) {
            while (!bytes.empty()) {
                const std::size_t at = made.size % block_size,
                                  count = std::min(bytes.size(), block_size - at);
                std::memcpy(&filling[at], bytes.data(), count);
                bytes.remove_prefix(count), made.size += count;
                if (made.size % block_size == 0) made.close(filling, before);
            }
        });
        write(archive);
        if (made.size % block_size != 0) made.close(filling, before);
        bytes_ += cost(all_.try_emplace(after, cycle, std::move(made))->second);
    }
    /// The bytes of the checkpoint of a cycle.
    std::string read(std::uint64_t cycle) const {
        const Checkpoint& found = all_.at(cycle);
        std::string out;
        out.reserve(found.blocks.size() * block_size);
        for (const auto& block : found.blocks) out.append(block->data(), block->size());
        out.resize(found.size);
        return out;
    }
    /// Drops every second one, but not the last.
    void thin() {
        bool drop = false;
        for (auto it = all_.begin(); it != all_.end(); drop = !drop)
            it = drop && std::next(it) != all_.end() ? remove(it) : std::next(it);
    }
    /// Drops those after a cycle.
    void cut(std::uint64_t cycle) {
        for (auto it = all_.upper_bound(cycle); it != all_.end();) it = remove(it);
    }
    void clear() { all_.clear(), bytes_ = 0; }

    bool contains(std::uint64_t cycle) const { return all_.contains(cycle); }
    std::size_t size() const { return all_.size(); }
    std::uint64_t first() const { return all_.begin()->first; }
    /// The cycle of the last one at or before `cycle`.
    std::uint64_t last(std::uint64_t cycle) const { return std::prev(all_.upper_bound(cycle))->first; }
    std::vector<std::uint64_t> cycles() const {
        std::vector<std::uint64_t> out;
        for (const auto& [cycle, checkpoint] : all_) out.push_back(cycle);
        return out;
    }
    /// The memory that they take.
    std::size_t bytes() const { return bytes_; }

  private:
    static constexpr std::size_t block_size = 4096;
    using Block = std::array<char, block_size>;
    struct Checkpoint {
        std::size_t size = 0;
        std::vector<std::shared_ptr<const Block>> blocks = {};
        /// Adds the block, or the equal one in its place in `before`.
        void close(const Block& block, const Checkpoint& before) {
            const auto at = blocks.size();
            const bool same = at < before.blocks.size() && *before.blocks[at] == block;
            blocks.push_back(same ? before.blocks[at] : std::make_shared<const Block>(block));
        }
    };
    using All = std::map<std::uint64_t, Checkpoint>;

    /// The memory that a checkpoint does not share.
    static std::size_t cost(const Checkpoint& c) {
        const auto own = std::ranges::count_if(c.blocks, [](const auto& b) { return b.use_count() == 1; });
        return static_cast<std::size_t>(own) * block_size + c.blocks.size() * sizeof(c.blocks[0]);
    }
    All::iterator remove(All::iterator it) {
        bytes_ -= cost(it->second);
        return all_.erase(it);
    }

    All all_;
    std::size_t bytes_ = 0;
};

}  // namespace forage::studio
