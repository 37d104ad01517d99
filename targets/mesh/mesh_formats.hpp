#pragma once

#include <string>
#include <string_view>

#include "model/base/invalid_input.hpp"
#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Walks over the words of a mesh file in text, knowing the place of each for messages. Lines end with LF, CR
/// or both.
class MeshTokens {
 public:
  /// @param text must outlive the object @param backslash_continues whether a line may go on after a
  /// backslash
  /// @param line number of the text's first line
  explicit MeshTokens(std::string_view text, bool backslash_continues = false, int line = 1);

  /// Moves to the start of the next line; false at the end of the text.
  bool next_line();
  /// Returns the next word of the line; empty at its end.
  std::string_view word();
  /// Returns the next word, of this line or a later one; empty at the end of the text.
  std::string_view word_of_any_line();

  std::string_view last_word() const { return text_.substr(word_start_, next_ - word_start_); }

  /// Reads the next word of the line as a number, in the file's units. @throws InvalidInput unless it is a finite one
  double number(const char* what);
  /// Reads the next word, of this line or a later one, as a number, in the file's units. @throws InvalidInput unless
  /// it is a finite one
  double number_of_any_line(const char* what);
  /// Reads a word as a number, in the file's units. @throws InvalidInput at the last word unless it is a finite one
  double number_in(std::string_view text, const char* what) const;
  /// Reads a word as a whole number. @throws InvalidInput at the last word unless it is one
  long integer_in(std::string_view text, const char* what) const;

  /// Returns an error at the last word.
  InvalidInput error(const std::string& fault_text) const;

 private:
  void skip_blanks();

  std::string_view text_;
  bool backslash_continues_;
  std::size_t next_ = 0, line_start_ = 0, word_start_ = 0;
  int line_;
  bool started_ = false;
};

/// Reads the triangles of a PLY file (Turk 1994), ASCII or binary of either byte order, in the file's units. It reads
/// the elements `vertex` with x, y, z and `face` with a list vertex_indices or vertex_index, and skips everything
/// else. Polygons are cut into fans.
/// @param bytes the whole file.
/// @throws InvalidInput without a file as place for a header without these elements, or data that end early. Counts
/// beyond what the bytes can hold throw before anything is allocated. Counts beyond the limits of mesh_file.hpp, an
/// index of a missing vertex, and a vertex that is not finite also throw.
TriangleMesh parse_ply(const std::string& bytes);

/// Reads the triangles of an OFF file in text, in the file's units. Polygons become fans of triangles. Colours,
/// normals and texture coordinates are ignored. https://www.geomview.org/docs/html/OFF.html
/// @throws InvalidInput with line and column as place for anything else, and for the limits of mesh_file.hpp
TriangleMesh parse_off(const std::string& bytes);

}  // namespace kinetix::targets

// Interface of kinetix-mesh.so to the program: see targets/mesh/mesh_file.hpp.

/// @param mesh to which triangles are added   @param refusal becomes why assimp refuses the file, if it does
extern "C" void kinetix_assimp_mesh(const std::string& bytes, const std::string& format,
                                    kinetix::targets::TriangleMesh& mesh, std::string& refusal);
