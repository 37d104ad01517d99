#pragma once

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "app/pictures/panel_picture.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::testing {

/// A far view as programs read it: contrast stretched, dark ink on white paper.
inline app::FarViewOptions as_ink_on_paper(app::FarViewOptions options, bool negative = true) {
  options.enhanced = options.on_white = true;
  options.negative = negative;
  return options;
}
inline const app::FarViewOptions as_ink = as_ink_on_paper({});

/// Returns the capitals that tesseract-ocr reads in a picture, as one raw line of text; empty if it reads nothing.
/// @param png a file's content   @throws std::runtime_error if the program does not run
inline std::string read_capitals(const std::string& png) {
  const TemporaryFolder folder;
  const std::string file = folder.path("letter.png");
  std::ofstream(file, std::ios::binary) << png;
  const std::string command =
      "OMP_THREAD_LIMIT=1 tesseract '" + file +
      "' - --psm 13 -c tessedit_char_whitelist=ABCDEFGHIJKLMNOPQRSTUVWXYZ 2>/dev/null";
  FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run tesseract");
  std::string text;
  std::array<char, 256> part;
  while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
  if (pclose(pipe) != 0) throw std::runtime_error("tesseract failed; is tesseract-ocr installed?");
  std::erase_if(text, [](char c) { return c < 'A' || c > 'Z'; });
  return text;
}

}  // namespace kinetix::testing
