// A program whose output is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace forage::video {

/// Runs a program while the object exists. The program is killed at the end.
class ChildProcess {
  public:
    /// Starts `arguments[0]`, which is searched in PATH. Throws std::runtime_error when that is not possible.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// The bytes that are there, after waiting for them for at most `milliseconds`. An empty text is the end
    /// of the output; nothing means that there were none in this time. Throws std::runtime_error.
    std::optional<std::string> read(int milliseconds);
    /// Waits for the program, whose output has ended. Returns whether it succeeded.
    bool succeeded();

  private:
    int process_ = -1, pipe_ = -1;
    std::optional<int> status_;  ///< of the program that has ended
};

}  // namespace forage::video
