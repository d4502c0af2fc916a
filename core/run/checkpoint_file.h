// Checkpoints on disk, which are complete or refused.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace forage {

/// There is no usable checkpoint; the message gives the reason.
class CheckpointError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The paths of the newest and of the previous checkpoint in a run's directory.
std::string checkpoint_path(const std::string& directory);
std::string previous_checkpoint_path(const std::string& directory);

/// `content` with a version, its length and a checksum (64-bit FNV-1a).
std::string sealed(std::string_view content);
/// The content that was sealed; `name` begins the messages ("checkpoint 'x'"). Throws CheckpointError.
std::string unsealed(std::string_view bytes, std::string_view name);

/// Writes the sealed content under a temporary name, and renames the file, so that a power cut leaves a
/// complete checkpoint. The old checkpoint becomes the previous one. Throws std::runtime_error.
void write_checkpoint(const std::string& directory, std::string_view content);
/// The content that write_checkpoint() wrote. Throws CheckpointError.
std::string read_checkpoint(const std::string& path);
/// Whether the directory has a checkpoint.
bool has_checkpoint(const std::string& directory);
/// Removes the newest and the previous checkpoint.
void remove_checkpoints(const std::string& directory);

}  // namespace forage
