// Recordings that are read back: the first byte chooses the format.
#include "core/base/named_file.h"
#include "core/observe/recording.h"
#include "tests/fuzz/holds.h"
#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static forage::test::ScratchFile csv(".csv"), npy(".npy");
    if (size == 0) return 0;
    auto& file = data[0] % 2 ? npy : csv;
    forage::Diagnostics diagnostics;
    try {
        for (auto& recording : forage::observe::open_recording(file.holding(data + 1, size - 1))) {
            std::uint64_t cycle = 0;
            std::vector<double> row;
            for (int i = 0; i < 1000 && recording->next(cycle, row); ++i)
                forage::test::holds(row.size() == recording->what().size(), "a row has a number per cell");
        }
    } catch (const forage::FileError& e) {
        report(e, diagnostics);
    }
    forage::test::sensible(diagnostics, std::string(size, '\n'));
    return 0;
}
