#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/console/console.hpp"
#include "app/files/design_file.hpp"

namespace kinetix::app {

/// What `kinetix-opt import` is asked for, besides what every command is.
struct ImportRequest {
  std::string model;          ///< one file with hard and soft parts, or a folder of tiles; or
  std::string hard, soft;     ///< one file of each; soft may be empty, where all hinges are pins
  std::string unit;           ///< mm, cm, m, in or ft; empty: the file's, else guessed by size
  std::string soft_material;  ///< name of the material, colour or object that is soft; empty: by its words
  std::string material;       ///< of soft parts, one of model::materials(); empty: tango
  std::string hinges;         ///< side file that settles ambiguous axes; empty: none
  std::optional<double> tile_mm = {};       ///< of tiles: their median edge, mm, > 0; nothing: 20 mm
  std::optional<double> thickness_mm = {};  ///< of tiles, mm, > 0; nothing: a twentieth of the median edge
  std::optional<double> kerf_mm =
      {};  ///< of tiles: width of cuts, mm, >= 0; nothing: 0.03 of the median edge
};

/// Of a design: its file's or folder's name, of letters, digits, `_`, `-` and `.`, at most 100.
std::string import_name(const ImportRequest& request);

/// design.yaml and its parts, all of them or none, and what was found on stdout: as JSON where that is asked for, else as text.
void write_import(const CommandOptions& options, const Design& design, const nlohmann::ordered_json& json,
                  const std::string& text);

}  // namespace kinetix::app
