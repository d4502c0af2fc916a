// A page that watches a run: its streams and its credit.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "tools/studio/server/stream.h"

namespace forage::studio {

/// The subscriptions of one page. Frames are made only while the page has acknowledged all but `window` of
/// them, so nothing is copied for a page that does not draw.
class Client {
  public:
    static constexpr std::uint32_t window = 2;
    static constexpr std::size_t max_streams = 256;

    /// Returns the number of the stream. Throws InputError when the page has too many.
    std::uint32_t subscribe(Stream stream);
    bool unsubscribe(std::uint32_t stream);
    const Stream& stream(std::uint32_t number) const { return streams_.at(number); }
    bool watches() const { return !streams_.empty(); }
    /// Subscribes everything again in a run that replaces the one before; streams that it does not have end.
    void rebind(Run& run, SourcePool& sources);
    /// Ends the streams of the run that went beside.
    void end_reference();

    /// Acknowledges all frames up to `seq`. Numbers of frames that were not sent are ignored.
    void acknowledge(std::uint32_t seq) {
        if (seq <= sent_ && seq > acknowledged_) acknowledged_ = seq;
    }
    std::uint32_t in_flight() const { return sent_ - acknowledged_; }

    void clear() {
        for (auto& [number, stream] : streams_) stream.clear();
    }
    /// The next frame; empty when the page has no credit, or nothing has changed since the last one:
    /// `version` is a number that grows with each change of the run.
    std::optional<std::string> frame(Run& run, std::uint64_t version, std::uint32_t epoch);

  private:
    std::map<std::uint32_t, Stream> streams_;
    std::uint32_t next_ = 1, sent_ = 0, acknowledged_ = 0;
    std::optional<std::uint64_t> version_;  ///< of the last frame
};

}  // namespace forage::studio
