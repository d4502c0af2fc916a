// Checkpoints on disk: whole, or refused.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace forage {

/// There is no checkpoint that can be used; the message says what is wrong with it.
class CheckpointError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Of a run's directory: the newest checkpoint, and the one before.
std::string checkpoint_path(const std::string& directory);
std::string previous_checkpoint_path(const std::string& directory);

/// Writes `content` with a version, its length and a checksum (64-bit FNV-1a), by way of another name, so
/// that it survives a power cut; the checkpoint that was there becomes the previous one. Throws
/// std::runtime_error.
void write_checkpoint(const std::string& directory, std::string_view content);
/// What write_checkpoint() wrote. Throws CheckpointError.
std::string read_checkpoint(const std::string& path);
/// Whether there is one.
bool has_checkpoint(const std::string& directory);
/// Removes both.
void remove_checkpoints(const std::string& directory);

}  // namespace forage
