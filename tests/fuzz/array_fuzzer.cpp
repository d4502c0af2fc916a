// Arrays: .npy files, recordings and CSV files in each form.
#include <cmath>

#include "core/base/array.h"
#include "tests/fuzz/holds.h"
#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using forage::Array;
    static forage::test::ScratchFile file(".npy");
    const auto& path = file.holding(data, size);
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto look = [&](const Array& array) {
        forage::Diagnostics diagnostics;
        for (const auto& fault : array.faults()) diagnostics.add(fault);
        forage::test::sensible(diagnostics, text + std::string(1, '\n'));
        if (diagnostics.failed() || array.rows() * array.columns() > 1'000'000) return;
        const auto numbers = array.numbers();
        const auto none =
            std::count_if(numbers.begin(), numbers.end(), [](double v) { return std::isnan(v); });
        forage::test::holds(
            static_cast<std::size_t>(none) == array.left_out() && array.left_out() < numbers.size(),
            "what is left out is counted, and something is not");
        for (const double v : numbers) forage::test::holds(!std::isinf(v), "numbers are finite");
    };
    for (const auto form : {Array::Form::matrix, Array::Form::list}) {
        look(*Array::read(path, form));
        look(*Array::parse(text, form, {nullptr, 1, 1}));
    }
    look(*Array::read(path, Array::Form::column, "u0"));
    return 0;
}
