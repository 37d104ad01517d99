#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/files/design_file.hpp"
#include "app/io/lock_file.hpp"

namespace kinetix::app::studio {

/// A design that was not saved, as it was kept.
struct KeptDesign {
  Design design;
  std::string save_file;               ///< where `save` writes it; empty: into a folder of results
  nlohmann::ordered_json result = {};  ///< the message of the result that it is of; null: none is known
};

/// The place on the disk for a design that is not saved (docs/studio.md, "What is not saved"): a folder with its design.yaml and, where it is what a
/// search found, its result.json. A studio that was killed finds it there; one that ends puts it aside.
/// Each running studio has a place of its own.
class Autosave {
 public:
  /// @param state the folder of all places   @param source what the studio was started with, an absolute path
  /// @throws InvalidInput where there can be none
  Autosave(const std::filesystem::path& state, const std::string& source);

  const std::filesystem::path& folder() const { return folder_; }
  /// What a studio that was killed left; nothing where there is none, or it cannot be read.
  std::optional<KeptDesign> kept() const;
  /// @param told the message of its result; null: none is known   @throws InvalidInput where it cannot be written
  void keep(const Design& design, const std::string& save_file, const nlohmann::ordered_json& told);
  /// It is saved.
  void forget();
  /// At the end of the program: the next studio does not begin with it. Nothing is kept from then on.
  /// @return the file of the design that was not saved; empty: all is saved
  std::string put_aside();

 private:
  std::filesystem::path folder_;
  std::unique_ptr<LockFile> lock_;  ///< beside the folder
  std::mutex mutex_;
  bool has_ended_ = false;
};

/// $XDG_STATE_HOME/kinetix/studio, by default ~/.local/state/kinetix/studio; empty where neither is known.
std::filesystem::path autosave_place();

}  // namespace kinetix::app::studio
