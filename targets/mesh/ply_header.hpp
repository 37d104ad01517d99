#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kinetix::targets {

/// Description of the data in a PLY file, from its header.
struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian };

  struct Number {
    int bytes = 0;
    bool is_float = false, is_signed = false;
  };
  struct Property {
    std::string name;
    Number number;
    bool is_list = false;
    Number count = {};  ///< of a list's length
  };
  struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;

    /// Position of a property; -1 when there is none.
    int find(const std::string& property) const;
    /// Bytes that one of these elements takes at least (every list empty).
    std::size_t least_bytes(Encoding encoding) const;
  };

  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data start
  int lines = 0;        ///< of the header
};

/// @throws InvalidInput with the line as place for anything that is not a header of PLY 1.0
PlyHeader parse_ply_header(const std::string& bytes);

}  // namespace kinetix::targets
