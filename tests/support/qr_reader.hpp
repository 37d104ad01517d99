#pragma once

#include <leptonica/allheaders.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace kinetix::testing {

/// Returns the output of a command. @throws std::runtime_error if it cannot be started
inline std::string output_of(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 256> part;
  while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
  pclose(pipe);
  return text;
}

/// Returns the text of the QR code that zbar finds in a picture, at a few distances and exposures as of a camera. Empty
/// if it finds none. @param png a file's content
inline std::string read_qr_code(const std::string& png) {
  const TemporaryFolder folder;
  PIX* const picture = pixReadMemPng(reinterpret_cast<const l_uint8*>(png.data()), png.size());
  if (!picture) throw std::runtime_error("no PNG");
  PIX* const grey = pixConvertTo8(picture, 0);
  const std::string file = folder.path("seen.png");
  std::string text;
  for (const float size : {0.5F, 0.45F, 0.4F, 0.36F, 0.33F, 0.3F, 0.28F, 0.25F})
    for (const int threshold : {128, 140, 153, 115, 105}) {
      if (!text.empty()) continue;
      PIX* far = pixScale(grey, size, size);
      PIX* ink = pixThresholdToBinary(far, threshold);
      pixWrite(file.c_str(), ink, IFF_PNG);
      text = output_of("zbarimg -q --raw '" + file + "' 2>/dev/null");
      pixDestroy(&far);
      pixDestroy(&ink);
    }
  PIX *first = picture, *second = grey;
  pixDestroy(&first);
  pixDestroy(&second);
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

/// Returns a PNG file of the QR code of version 1 with this text, one pixel per module, with a margin of two modules.
inline std::string draw_qr_code(const std::string& text, const std::string& file) {
  output_of("qrencode -o '" + file + "' -s 1 -m 2 -l L -v 1 '" + text + "'");
  return file;
}

}  // namespace kinetix::testing
