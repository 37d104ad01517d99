#pragma once

#include <string>

namespace kinetix::app {

/// What `kinetix-opt import` is asked for, besides what every command is.
struct ImportRequest {
  std::string model;          ///< one file with hard and soft parts; or
  std::string hard, soft;     ///< one file of each; soft may be empty, where all hinges are pins
  std::string unit;           ///< mm, cm, m, in or ft; empty: the file's, else guessed by size
  std::string soft_material;  ///< name of the material, colour or object that is soft; empty: by its words
  std::string material;       ///< of soft parts, one of model::materials(); empty: tango
  std::string hinges;         ///< side file that settles ambiguous axes; empty: none
};

}  // namespace kinetix::app
