// Recordings in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/column.h"
#include "core/observe/observer.h"
#include "core/observe/source.h"

namespace forage {

/// Records a source in memory, one row per recorded cycle.
class MemoryRecorder final : public Observer {
  public:
    using Rows = Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

    /// Records every `every`-th cycle, from cycle 0 on.
    explicit MemoryRecorder(observe::Source source, std::uint64_t every = 1)
        : source_(std::move(source)), every_(every) {}

    const observe::Recorded& what() const { return source_.what(); }
    std::uint64_t every() const { return every_; }
    /// The recorded cycles.
    const std::vector<std::uint64_t>& cycles() const { return cycles_; }
    /// The recorded numbers: one row per recorded cycle, one column per cell. Valid until the next cycle.
    Rows rows() const {
        return {numbers_->data(), static_cast<Index>(cycles_.size()),
                static_cast<Index>(source_.what().size())};
    }

    /// The memory of rows(). Whoever shares it sees the rows of now also after further cycles.
    std::shared_ptr<const std::vector<double>> numbers() const { return numbers_; }

    /// What was recorded since the start, or since the last call.
    struct Taken {
        std::vector<std::uint64_t> cycles;
        std::vector<double> numbers;  ///< of all rows
    };
    /// Hands over what was recorded, and forgets it.
    Taken take();

    void declare(engine::Demand& demand) const override { source_.declare(demand); }
    void after_cycle(RunView& view) override;
    void checkpoint(Archive& archive) override;

  private:
    observe::Source source_;
    std::uint64_t every_;
    std::vector<std::uint64_t> cycles_;
    std::shared_ptr<std::vector<double>> numbers_ = std::make_shared<std::vector<double>>();
};

}  // namespace forage
