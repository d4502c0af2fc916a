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

#include "core/observe/observer.h"
#include "core/run/run.h"

namespace forage::studio {

/// The types of numbers in a frame, as docs/design/studio-protocol.md numbers them.
enum class Type : std::uint8_t { float32, float64, uint8 };

/// Whether a page gets the newest numbers only, or every cycle.
enum class Delivery { latest, append };

/// What a stream puts into a frame.
struct Chunk {
    std::uint32_t rows = 0, columns = 0;
    Type type = Type::float32;
    bool gap = false;    ///< whether rows before the first one were dropped
    bool pairs = false;  ///< whether rows hold the smallest and largest number of several cycles
    float lowest = 0, highest = 0;
    std::string bytes;
};

/// Where the numbers of a stream come from.
class StreamSource {
  public:
    virtual ~StreamSource() = default;
    virtual std::uint32_t rows() const = 0;
    virtual std::uint32_t columns() const = 0;
    virtual std::string label() const = 0;
    virtual Type type() const { return Type::float32; }
    /// Reads rows() * columns() numbers as they are now.
    virtual void read(Run& run, std::span<double> out) const = 0;
    /// Adds to `demand` what is read.
    virtual void declare(engine::Demand&) const {}
};

/// The source that a page names: an expression of sources, or "world:poses", "world:rays:ROBOT",
/// "world:camera:ROBOT", "world:trail:ROBOT". Throws InputError.
std::unique_ptr<StreamSource> find_stream_source(Run& run, std::string_view text, Delivery delivery);

/// A source that all its streams share: it is read, drawn and packed once, however many pages watch it. A
/// version is a number that grows with each change of the run.
class SharedSource {
  public:
    SharedSource(Run& run, std::unique_ptr<StreamSource> source)
        : run_(run),
          source_(std::move(source)),
          numbers_(static_cast<std::size_t>(source_->rows()) * source_->columns()) {}
    const StreamSource& source() const { return *source_; }
    /// The numbers as they are now.
    std::span<const double> numbers(std::uint64_t version);
    /// The same, for a frame.
    const Chunk& chunk(std::uint64_t version);

  private:
    Run& run_;
    std::unique_ptr<StreamSource> source_;
    std::vector<double> numbers_;
    Chunk chunk_;
    std::optional<std::uint64_t> read_, packed_;  ///< versions
};

/// The sources of a run, and of another one that goes beside it, that pages watch.
class SourcePool {
  public:
    static constexpr std::string_view beside = "reference:";
    /// The source that a page names, as find_stream_source() finds it; after "reference:" one of the run
    /// beside, which may be null. Throws InputError.
    std::shared_ptr<SharedSource> find(Run& run, Run* reference, const std::string& text, Delivery delivery);
    /// Forgets all: the run is replaced by another one.
    void clear() { sources_.clear(); }

  private:
    std::map<std::pair<std::string, Delivery>, std::weak_ptr<SharedSource>> sources_;
};

/// A source with a delivery. A stream of every cycle keeps the rows that were not taken, up to a bound.
class Stream {
  public:
    Stream(std::shared_ptr<SharedSource> source, std::string text, Delivery delivery, std::uint64_t every);

    const std::string& text() const { return text_; }
    Delivery delivery() const { return delivery_; }
    std::uint64_t every() const { return every_; }
    const StreamSource& source() const { return source_->source(); }

    /// Notes the numbers of the last cycle, if the stream is one of every cycle.
    void after_cycle(std::uint64_t cycle, std::uint64_t version);
    /// The newest numbers, or the rows since the last call. Valid until the next call.
    const Chunk& take(std::uint64_t version);
    /// Forgets the rows: the run begins anew or goes back.
    void clear();

  private:
    void push(std::uint64_t cycle, std::span<const double> numbers);

    std::shared_ptr<SharedSource> source_;
    std::string text_;
    Delivery delivery_;
    std::uint64_t every_, first_ = 0, joined_ = 0;  ///< of the row that grows
    std::size_t row_size_, most_rows_;
    std::vector<double> low_, high_, rows_;
    bool gap_ = false;
    Chunk chunk_;
};

}  // namespace forage::studio
