#include "tools/studio/server/checkpoints.h"

#include <cstddef>
#include <string>

#include "tests/support/catch.h"

namespace {

using namespace forage;
using namespace forage::studio;

constexpr std::size_t block = 4096;

/// Bytes that differ everywhere from those of another seed.
std::string bytes_of(std::size_t size, char seed) {
    std::string out(size, seed);
    for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<char>(out[i] + 7 * static_cast<char>(i % 31));
    return out;
}

void add(Checkpoints& to, std::uint64_t cycle, std::string bytes) {
    to.add(cycle, [&](Archive& archive) { archive.numbers(bytes.data(), bytes.size()); });
}

/// What a run writes whose weights rest while its list of trials grows.
std::string of_trials(std::size_t count) {
    std::string out = bytes_of(50 * block, 'w');
    for (std::size_t i = 0; i < count; ++i) out += bytes_of(77, static_cast<char>(i));
    return out + "the end";
}

}  // namespace

TEST_CASE("a checkpoint is read as it was written") {
    Checkpoints checkpoints;
    const std::size_t sizes[] = {3 * block, 0, 1, block - 1, 2 * block, block, block + 1, 5 * block + 17};
    std::uint64_t cycle = 0;
    for (const char seed : {'a', 'a', 'b'})
        for (const std::size_t size : sizes) add(checkpoints, ++cycle * 10, bytes_of(size, seed));
    add(checkpoints, 95, bytes_of(4 * block, 'b'));  // a run that went back makes one between others
    CHECK(checkpoints.read(95) == bytes_of(4 * block, 'b'));
    checkpoints.thin();
    checkpoints.cut(200);
    CHECK(checkpoints.cycles() ==
          std::vector<std::uint64_t>{10, 30, 50, 70, 90, 100, 120, 140, 160, 180, 200});
    for (const std::uint64_t at : checkpoints.cycles())
        CHECK(checkpoints.read(at) ==
              bytes_of(sizes[(at / 10 - 1) % std::size(sizes)], at > 160 ? 'b' : 'a'));
    CHECK(checkpoints.last(119) == 100);
}

TEST_CASE("what does not change between checkpoints is kept once") {
    Checkpoints checkpoints;
    add(checkpoints, 0, of_trials(1000));
    const std::size_t first = checkpoints.bytes();
    for (std::uint64_t i = 1; i <= 100; ++i) add(checkpoints, i, of_trials(1000 + i));
    CHECK(checkpoints.read(100) == of_trials(1100));
    // The last block, which grows, and a pointer to each of the others.
    CHECK(checkpoints.bytes() < first + 100 * (2 * block + 100 * sizeof(std::shared_ptr<int>)));
}

TEST_CASE("checkpoints that go give back what no other one shares") {
    Checkpoints all, alone;
    for (std::uint64_t i = 0; i <= 8; ++i) add(all, i, of_trials(100 * i));
    while (all.size() > 2) all.thin();
    add(alone, 0, of_trials(0)), add(alone, 8, of_trials(800));
    CHECK(all.cycles() == alone.cycles());
    CHECK(all.bytes() == alone.bytes());
    all.cut(0);
    Checkpoints first;
    add(first, 0, of_trials(0));
    CHECK(all.bytes() == first.bytes());
    all.clear();
    CHECK(all.bytes() == 0);
}
