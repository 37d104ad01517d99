#pragma once

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/files/design_file.hpp"
#include "app/io/atomic_file.hpp"

namespace kinetix::app::studio {

/// Returns the message `result` (studio-protocol.md) of the result.json next to a design file: its goal and its
/// errors.
/// Null if there is no such file, it cannot be read, it had no goal, or its sheet differs: bodies or hinges
/// by more than the rounding of design files.
nlohmann::ordered_json earlier_result(const std::string& design_file, const Design& design);

/// Returns the theta of the state that the result of such a message shows, rad; empty without one.
std::optional<double> theta_reached(const nlohmann::ordered_json& message);

/// Design that was not saved, as it was kept.
struct AutosavedDesign {
  Design design;
  std::string save_file;               ///< `save` writes it here; empty: into a folder of results
  nlohmann::ordered_json result = {};  ///< message of the result that it belongs to; null: none
};

/// Folder on the disk for a design that is not saved (studio.md, "What is not saved"). It has the
/// design.yaml, and the result.json if a search found the design. After a crash the next studio finds it
/// there; a regular end moves it aside. Each running studio has a separate folder.
class Autosave {
 public:
  /// @param state the folder of all places   @param source file that the studio was started with, an absolute
  /// path
  /// @throws InvalidInput if no place can be made
  Autosave(const std::filesystem::path& state, const std::string& source);

  const std::filesystem::path& folder() const { return folder_; }
  /// Reads the design that a killed studio left; empty if there is none, or it cannot be read.
  std::optional<AutosavedDesign> kept() const;
  /// @param told message of its result; null: none   @throws InvalidInput if it cannot be written
  void keep(const Design& design, const std::string& save_file, const nlohmann::ordered_json& result_message);
  /// Removes the kept design after a save.
  void forget();
  /// Moves the design aside at the end of the program: the next studio does not open it. Later calls keep
  /// nothing.
  /// @return file of the design that was not saved; empty: all is saved
  std::string put_aside();

 private:
  std::filesystem::path folder_;
  std::unique_ptr<LockFile> lock_;  ///< next to the folder
  std::mutex mutex_;
  bool has_ended_ = false;
};

/// Returns $XDG_STATE_HOME/kinetix/studio, by default ~/.local/state/kinetix/studio; empty if neither is
/// known.
std::filesystem::path autosave_place();

}  // namespace kinetix::app::studio
