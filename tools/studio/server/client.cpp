#include "tools/studio/server/client.h"

#include <cstring>
#include <vector>

#include <fmt/format.h>

namespace forage::studio {
namespace {

template <class T>
void put(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value),
               sizeof value);  // the project runs on little endian only
}

}  // namespace

std::uint32_t Client::subscribe(Stream stream) {
    if (streams_.size() >= max_streams)
        throw InputError(fmt::format("a page has at most {} streams", max_streams), "close some plots");
    streams_.emplace(next_, std::move(stream));
    version_.reset();
    return next_++;
}

void Client::rebind(Run& run, SourcePool& sources) {
    for (auto it = streams_.begin(); it != streams_.end();) {
        const Stream& old = it->second;
        try {
            it->second = sources.stream(run, nullptr, old.text(), old.delivery(), old.every());
            ++it;
        } catch (const InputError&) {
            it = streams_.erase(it);
        }
    }
    version_.reset();
}

void Client::end_reference() {
    std::erase_if(streams_, [](const auto& s) { return s.second.text().starts_with(SourcePool::beside); });
}

bool Client::unsubscribe(std::uint32_t stream) { return streams_.erase(stream) > 0; }

std::optional<std::string> Client::frame(Run& run, std::uint64_t version, std::uint32_t epoch) {
    if (streams_.empty() || in_flight() >= window || version_ == version) return std::nullopt;
    version_ = version;
    std::vector<const Chunk*> chunks;
    for (auto& [number, stream] : streams_) chunks.push_back(&stream.take(version));
    std::string out = "FRG1";
    put(out, std::uint16_t{1}), put(out, static_cast<std::uint16_t>(streams_.size()));
    put(out, ++sent_), put(out, epoch), put(out, run.cycle()), put(out, run.seconds());
    const auto aligned = [](std::size_t at) { return (at + 7) / 8 * 8; };
    std::size_t end = 32 + 32 * streams_.size();
    auto chunk = chunks.begin();
    for (const auto& [number, stream] : streams_) {
        const Chunk& c = **chunk++;
        end = aligned(end);
        put(out, number), put(out, c.rows), put(out, c.columns);
        put(out, static_cast<std::uint8_t>(c.type));
        put(out, static_cast<std::uint8_t>((c.gap ? 1 : 0) | (c.joined ? 2 : 0)));
        put(out, std::uint16_t{0}), put(out, c.lowest), put(out, c.highest);
        put(out, static_cast<std::uint32_t>(end)), put(out, static_cast<std::uint32_t>(c.bytes.size()));
        end += c.bytes.size();
    }
    out.reserve(end);
    for (const Chunk* c : chunks) {
        out.resize(aligned(out.size()));
        out += c->bytes;
    }
    return out;
}

}  // namespace forage::studio
