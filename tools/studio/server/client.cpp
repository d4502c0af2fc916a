#include "tools/studio/server/client.h"

#include <cstring>

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
    if (streams_.size() >= most_streams)
        throw InputError(fmt::format("a page has at most {} streams", most_streams), "close some plots");
    streams_.emplace(next_, std::move(stream));
    version_.reset();
    list();
    return next_++;
}

void Client::rebind(Run& run, SourcePool& sources) {
    for (auto it = streams_.begin(); it != streams_.end();) {
        const Stream& old = it->second;
        try {
            it->second = Stream(sources.find(run, nullptr, old.text(), old.delivery()), old.text(),
                                old.delivery(), old.every());
            ++it;
        } catch (const InputError&) {
            it = streams_.erase(it);
        }
    }
    version_.reset();
    list();
}

void Client::end_reference() {
    std::erase_if(streams_, [](const auto& s) { return s.second.text().starts_with(SourcePool::beside); });
    list();
}

bool Client::unsubscribe(std::uint32_t stream) {
    const bool found = streams_.erase(stream) > 0;
    list();
    return found;
}

void Client::list() {
    every_cycle_.clear();
    for (auto& [number, stream] : streams_)
        if (stream.delivery() == Delivery::append) every_cycle_.push_back(&stream);
}

std::optional<std::string> Client::frame(Run& run, std::uint64_t version, std::uint32_t epoch) {
    if (streams_.empty() || in_flight() >= window || version_ == version) return std::nullopt;
    version_ = version;
    const std::size_t head = 32 + 32 * streams_.size();
    std::string payload, table;
    for (auto& [number, stream] : streams_) {
        const Chunk& c = stream.take(version);
        payload.resize((payload.size() + 7) / 8 * 8);
        put(table, number), put(table, c.rows), put(table, c.columns);
        put(table, static_cast<std::uint8_t>(c.type));
        put(table, static_cast<std::uint8_t>((c.gap ? 1 : 0) | (c.pairs ? 2 : 0)));
        put(table, std::uint16_t{0}), put(table, c.lowest), put(table, c.highest);
        put(table, static_cast<std::uint32_t>(head + payload.size()));
        put(table, static_cast<std::uint32_t>(c.bytes.size()));
        payload += c.bytes;
    }
    std::string out = "FRG1";
    out.reserve(head + payload.size());
    put(out, std::uint16_t{1}), put(out, static_cast<std::uint16_t>(streams_.size()));
    put(out, ++sent_), put(out, epoch), put(out, run.cycle()), put(out, run.seconds());
    return out += table, out += payload;
}

}  // namespace forage::studio
