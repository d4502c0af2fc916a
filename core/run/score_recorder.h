// The table of a game.
#pragma once

#include "core/observe/observer.h"
#include "core/run/environment.h"
#include "core/run/result_files.h"

namespace forage {

/// Writes score.csv at the end of a run in which a game is played.
class ScoreRecorder final : public Observer {
  public:
    std::vector<std::string> file_names() const override { return {"score.csv"}; }
    void finish(RunView& run, ResultFiles& files) override {
        files.write("score.csv", [&] { return run.environment->score_csv(); });
    }
};

}  // namespace forage
