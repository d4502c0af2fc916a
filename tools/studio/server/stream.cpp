#include "tools/studio/server/stream.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

namespace forage::studio {
namespace {

constexpr std::size_t max_kept = 4 << 20;  ///< bytes of rows that pages may fetch

template <class T>
std::string bytes_of(std::span<const double> numbers) {
    std::string out(numbers.size() * sizeof(T), '\0');
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto v = static_cast<T>(numbers[i]);
        std::memcpy(out.data() + i * sizeof(T), &v, sizeof(T));
    }
    return out;
}

/// The lowest and highest of the finite numbers, in rows of `row` numbers without the first `head`.
void set_range(Chunk& chunk, std::span<const double> numbers, std::size_t row = 1, std::size_t head = 0) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i % row < head) continue;
        if (const auto v = static_cast<float>(numbers[i]); std::isfinite(v))
            low = std::min(low, v), high = std::max(high, v);
    }
    chunk.lowest = low <= high ? low : 0, chunk.highest = low <= high ? high : 0;
}

}  // namespace

std::span<const double> SharedSource::numbers(std::uint64_t version) {
    if (read_ != version) source_.read(run_, numbers_), read_ = version;
    return numbers_;
}

const Chunk& SharedSource::chunk(std::uint64_t version) {
    if (packed_ == version) return chunk_;
    const auto all = numbers(version);
    chunk_.type = source_.type;
    chunk_.rows = source_.rows, chunk_.columns = source_.columns;
    set_range(chunk_, all);
    chunk_.bytes = chunk_.type == Type::float32 ? bytes_of<float>(all) : bytes_of<std::uint8_t>(all);
    packed_ = version;
    return chunk_;
}

Rows::Rows(std::shared_ptr<SharedSource> source, std::uint64_t every)
    : source_(std::move(source)),
      every_(every),
      columns_(head() +
               std::size_t{source_->source().rows} * source_->source().columns * (every > 1 ? 3 : 1)),
      max_rows_(std::max<std::size_t>(64, max_kept / (columns_ * sizeof(double)))) {}

std::span<const double> Rows::from(std::uint64_t row) const {
    return std::span(numbers_).subspan(static_cast<std::size_t>(row - begin_) * columns_);
}

void Rows::clear() { begin_ = end(), cycles_ = 0, numbers_.clear(); }

// Rows begin at the same cycles in all streams, also in those that began later.
bool Rows::begins_at(std::uint64_t cycle) const {
    return cycle % every_ == 0 || (cycle < every_ && std::has_single_bit(cycle));
}

void Rows::after_cycle(std::uint64_t cycle, std::uint64_t version) {
    if (cycles_ == 0 && !begins_at(cycle)) return;
    const auto now = source_->numbers(version);
    if (every_ == 1) {
        push(cycle);
        numbers_.insert(numbers_.end(), now.begin(), now.end());
        return;
    }
    if (cycles_++ == 0) {
        first_ = cycle, joined_.clear();
        for (const double v : now) joined_.push_back({v, v, v, false});
    } else {
        for (std::size_t i = 0; i < now.size(); ++i) {
            Joined& j = joined_[i];
            if (now[i] < j.low) j.low = now[i], j.falls = true;
            if (now[i] > j.high) j.high = now[i], j.falls = false;
            j.sum += now[i];
        }
    }
    if (!begins_at(cycle + 1)) return;
    push(first_);
    const auto cycles = static_cast<double>(cycles_);
    numbers_.push_back(cycles);
    for (const Joined& j : joined_) {
        const auto [first, second] = j.falls ? std::pair(j.high, j.low) : std::pair(j.low, j.high);
        numbers_.insert(numbers_.end(), {first, second, j.sum / cycles});
    }
    cycles_ = 0;
}

void Rows::drop_before(std::uint64_t row) {
    const auto numbers = static_cast<std::ptrdiff_t>((row - begin_) * columns_);
    numbers_.erase(numbers_.begin(), numbers_.begin() + numbers);
    begin_ = row;
}

void Rows::push(std::uint64_t cycle) {
    if (end() - begin_ >= max_rows_) drop_before(begin_ + max_rows_ / 2);
    numbers_.push_back(static_cast<double>(cycle));
}

Stream::Stream(std::string text, std::shared_ptr<SharedSource> source, std::shared_ptr<Rows> rows,
               std::uint64_t every)
    : text_(std::move(text)), source_(std::move(source)), rows_(std::move(rows)), every_(every) {
    if (rows_) next_ = rows_->end();
}

void Stream::clear() {
    if (!rows_) return;
    rows_->clear();
    next_ = rows_->end();
}

const Chunk& Stream::take(std::uint64_t version) {
    if (!rows_) return source_->chunk(version);
    const std::uint64_t first = rows_->begin();
    const auto numbers = rows_->from(std::max(next_, first));
    chunk_.type = Type::float64;
    chunk_.columns = static_cast<std::uint32_t>(rows_->columns());
    chunk_.rows = static_cast<std::uint32_t>(numbers.size() / rows_->columns());
    chunk_.gap = first > next_;
    chunk_.joined = every_ > 1;
    set_range(chunk_, numbers, rows_->columns(), rows_->head());
    chunk_.bytes = bytes_of<double>(numbers);
    next_ = rows_->end();
    // A page that watches alone needs none of them again; of several, each fetches at its own time.
    if (rows_.use_count() == 1) rows_->drop_before(next_);
    return chunk_;
}

std::shared_ptr<SharedSource> SourcePool::find(Run& run, Run* reference, const std::string& text,
                                               Delivery delivery) {
    if (const auto known = sources_.find({text, delivery}); known != sources_.end())
        if (auto shared = known->second.lock()) return shared;
    std::erase_if(sources_, [](const auto& s) { return s.second.expired(); });
    std::string_view name = text;
    Run* of = &run;
    if (name.starts_with(beside)) name.remove_prefix(beside.size()), of = reference;
    if (!of)
        throw InputError(fmt::format("'{}' needs a run to compare with", text),
                         "the command compare begins one");
    auto made = std::make_shared<SharedSource>(*of, find_stream_source(*of, name, delivery));
    sources_[{text, delivery}] = made;
    return made;
}

Stream SourcePool::stream(Run& run, Run* reference, const std::string& text, Delivery delivery,
                          std::uint64_t every) {
    every = std::max<std::uint64_t>(every, 1);
    auto source = find(run, reference, text, delivery);
    std::shared_ptr<Rows> rows;
    if (delivery == Delivery::append) {
        std::erase_if(rows_, [](const auto& known) { return known.expired(); });
        for (const auto& known : rows_)
            if (auto shared = known.lock(); shared->matches(*source, every)) rows = shared;
        if (!rows) rows_.push_back(rows = std::make_shared<Rows>(source, every));
    }
    return Stream(text, std::move(source), std::move(rows), every);
}

}  // namespace forage::studio
