#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/console/console.hpp"
#include "app/console/short_form.hpp"
#include "app/files/design_file.hpp"

namespace kinetix::app {

/// Options of `kinetix-opt import`, except those of all commands.
struct ImportRequest {
  std::string model;  ///< one file with hard and soft parts, or a folder of tiles; empty: `hard` and `soft`
  std::string hard, soft;  ///< one file of each; soft may be empty if all hinges are pins
  std::string unit;        ///< mm, cm, m, in or ft; empty: the file's, else inferred from the size
  std::string
      soft_material;  ///< name of the soft material, colour or object; empty: recognised by words; none: all are hard
  std::string material;                     ///< of soft parts, one of model::materials(); empty: tango
  std::string hinges;                       ///< side file that sets ambiguous axes; empty: none
  std::optional<double> tile_mm = {};       ///< median edge of tiles, mm, > 0; empty: 20 mm
  std::optional<double> thickness_mm = {};  ///< of tiles, mm, > 0; empty: a twentieth of the median edge
  std::optional<double> kerf_mm = {};       ///< width of cuts, mm, >= 0; empty: 0.03 of the median edge
};

/// Returns the name of a design: that of its file or folder in letters, digits, `_`, `-` and `.`. It is cut to 100
/// characters. An empty name, or one with a leading point, then gets `_` in front.
std::string import_name(const ImportRequest& request);

/// Writes design.yaml and its parts, all of them or none. Prints the form, which gets its last line here, or JSON if requested.
void write_import(const CommandOptions& options, const Design& design, const nlohmann::ordered_json& json,
                  ShortForm form);

/// Runs `kinetix-opt import MODEL|--hard A --soft B -o DIR`: makes a design of general bodies from a 3D model. Writes
/// design.yaml and its part files, all of them or none. @return the exit code. @throws InvalidInput for unusable
/// models
int import_command(const CommandOptions& options, const ImportRequest& request);

}  // namespace kinetix::app
