// A stream: numbers of a run that a page watches.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/studio/server/stream_source.h"

namespace forage::studio {

/// What a stream puts into a frame.
struct Chunk {
    std::uint32_t rows = 0, columns = 0;
    Type type = Type::float32;
    bool gap = false;     ///< whether rows before the first one were dropped
    bool joined = false;  ///< whether rows are of several cycles
    float lowest = 0, highest = 0;
    std::string bytes;
};

/// A source that all its streams share: it is read, drawn and packed once, however many pages watch it. A
/// version is a number that grows with each change of the run.
class SharedSource {
  public:
    SharedSource(Run& run, StreamSource source)
        : run_(run), source_(std::move(source)), numbers_(std::size_t{source_.rows} * source_.columns) {}
    const StreamSource& source() const { return source_; }
    /// The numbers as they are now.
    std::span<const double> numbers(std::uint64_t version);
    /// The same, for a frame.
    const Chunk& chunk(std::uint64_t version);

  private:
    Run& run_;
    StreamSource source_;
    std::vector<double> numbers_;
    Chunk chunk_;
    std::optional<std::uint64_t> read_, packed_;  ///< versions
};

/// The newest rows of a source, which all its streams with the same decimation share: one row for each cycle,
/// or for `every` of them. The first rows of a run begin at the cycles 0, 1, 2, 4 and so on, so that a short
/// run has rows. A row of several cycles has how many it joins, and of each number the smallest and the
/// largest, in the order in which they came, and the mean. Rows are counted from 0; the oldest are dropped
/// when there are too many.
class Rows {
  public:
    Rows(std::shared_ptr<SharedSource> source, std::uint64_t every);
    bool matches(const SharedSource& source, std::uint64_t every) const {
        return source_.get() == &source && every_ == every;
    }

    /// The numbers of a row, and how many of them come before those of the cells.
    std::size_t columns() const { return columns_; }
    std::size_t head() const { return every_ > 1 ? 2 : 1; }
    std::uint64_t begin() const { return begin_; }
    std::uint64_t end() const { return begin_ + numbers_.size() / columns_; }
    /// The rows from number `row` on, which is in [begin(), end()].
    std::span<const double> from(std::uint64_t row) const;

    void after_cycle(std::uint64_t cycle, std::uint64_t version);
    /// Drops the rows before this one, which is in [begin(), end()].
    void drop_before(std::uint64_t row);
    /// Drops all rows: the run restarts or goes back.
    void clear();

  private:
    struct Joined {
        double low, high, sum;
        bool falls;  ///< whether the largest came first
    };
    bool begins_at(std::uint64_t cycle) const;
    /// Begins a row, which the numbers follow.
    void push(std::uint64_t cycle);

    std::shared_ptr<SharedSource> source_;
    std::uint64_t every_, begin_ = 0;
    std::uint64_t first_ = 0, cycles_ = 0;  ///< of the row that grows
    std::vector<Joined> joined_;            ///< of that row
    std::size_t columns_, max_rows_;
    std::vector<double> numbers_;
};

/// A source with a delivery, for one page. A stream of every cycle gets the rows since the last time.
class Stream {
  public:
    /// `rows` is null for a stream of the newest numbers only.
    Stream(std::string text, std::shared_ptr<SharedSource> source, std::shared_ptr<Rows> rows,
           std::uint64_t every);

    const std::string& text() const { return text_; }
    Delivery delivery() const { return rows_ ? Delivery::append : Delivery::latest; }
    std::uint64_t every() const { return every_; }
    const StreamSource& source() const { return source_->source(); }

    /// The newest numbers, or the rows since the last call. Valid until the next call.
    const Chunk& take(std::uint64_t version);
    /// Forgets the rows: the run restarts or goes back.
    void clear();

  private:
    std::string text_;
    std::shared_ptr<SharedSource> source_;
    std::shared_ptr<Rows> rows_;
    std::uint64_t every_, next_ = 0;  ///< row
    Chunk chunk_;
};

/// What pages watch of a run, and of another one that runs next to it.
class SourcePool {
  public:
    static constexpr std::string_view beside = "reference:";
    /// The source that a page names, as find_stream_source() finds it; after "reference:" one of the run
    /// beside, which may be null. Throws InputError.
    std::shared_ptr<SharedSource> find(Run& run, Run* reference, const std::string& text, Delivery delivery);
    /// A stream of that source. Throws InputError.
    Stream stream(Run& run, Run* reference, const std::string& text, Delivery delivery, std::uint64_t every);
    /// Notes the numbers of the last cycle for streams of every cycle.
    void after_cycle(std::uint64_t cycle, std::uint64_t version) {
        for (const auto& rows : rows_)
            if (const auto watched = rows.lock()) watched->after_cycle(cycle, version);
    }
    /// Forgets all: the run is replaced by another one.
    void clear() { sources_.clear(), rows_.clear(); }

  private:
    std::map<std::pair<std::string, Delivery>, std::weak_ptr<SharedSource>> sources_;
    std::vector<std::weak_ptr<Rows>> rows_;
};

}  // namespace forage::studio
