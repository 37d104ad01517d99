#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace kinetix::testing {

namespace fs = std::filesystem;

inline std::string text_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A temporary folder for one test, removed at its end.
class Scratch {
 public:
  Scratch() {
    std::string pattern = fs::temp_directory_path() / "kinetix-test-XXXXXX";
    path_ = mkdtemp(pattern.data());
  }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string path() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  fs::path path_;
};

struct Outcome {
  int code = 0;
  std::string out, err;
};

/// Runs the program with arguments that are already quoted for the shell. Its output is the short form.
/// @param before shell commands that run first
inline Outcome short_run(const std::string& arguments, const std::string& before = "") {
  const Scratch scratch;
  const std::string out = scratch / "out", err = scratch / "err";
  const int status = std::system(
      (before + KINETIX_OPT + " " + arguments + " >" + out + " 2>" + err + " </dev/null").c_str());
  return {WEXITSTATUS(status), text_of(out), text_of(err)};
}

/// Runs the program with `-v`, so that its output has all results.
inline Outcome kinetix_opt(const std::string& arguments, const std::string& before = "") {
  return short_run("-v " + arguments, before);
}

}  // namespace kinetix::testing
