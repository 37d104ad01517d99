#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

constexpr unsigned longest_s = 20;        // of one input: as long as a user would wait for an answer
constexpr std::size_t max_bytes = 65536;  // of an input: larger ones take time and find little more
constexpr std::uint64_t seed = 1;         // of all changes: the same inputs in each run
constexpr int max_changes = 6;            // in one input: with more changes little of the original remains

/// Words that readers often handle wrongly.
const std::vector<std::string> words = {
    "0",           "-1",         "1e308", "-1e308", "1e-320", "nan",  "inf",  "2147483647",
    "-2147483648", "4294967296", "1e9",   "[1, 1]", "[]",     "{}",   "null", "\"\"",
    "~",           ",",          ": ",    "\n",     "\t",     "\r\n", "\xff", "0.5",
    "90",          "89.999",     "true",  "x",      "/",      "../",  "#",    "'"};

std::string input;  ///< currently being read

/// Keeps the input. Calls only functions that are safe in a signal handler.
void keep_input(int signal) {
  const int file = open("failed_input", O_CREAT | O_TRUNC | O_WRONLY, 0644);
  if (file >= 0 && write(file, input.data(), input.size()) >= 0) close(file);
  const char text[] = "\nthe input is kept in failed_input\n";
  if (write(2, text, sizeof text - 1) < 0 || signal == SIGALRM) _exit(1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void read_input() {
  alarm(longest_s);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  alarm(0);
}

std::vector<std::string> inputs_of(int count, char** folders) {
  std::vector<fs::path> files;
  for (int k = 0; k < count; ++k)
    for (const auto& file : fs::directory_iterator(folders[k]))
      if (file.is_regular_file() && file.file_size() <= max_bytes) files.push_back(file.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> all;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    all.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return all;
}

/// Changes inputs with a generator that the standard defines, so all compilers give the same changes.
class Mutator {
 public:
  explicit Mutator(const std::vector<std::string>& all) : all_(all) {}

  std::string next() {
    std::string text = all_[below(all_.size())];
    for (std::size_t k = 1 + below(max_changes); k > 0; --k) change(text);
    if (text.size() > max_bytes) text.resize(max_bytes);
    return text;
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }

  /// Returns a stretch of up to 64 bytes, in most cases short.
  std::string_view stretch(const std::string& text) {
    const std::size_t start = below(text.size());
    return std::string_view(text).substr(start, 1 + below(1 + below(64)));
  }

  /// Returns the range of the number or word around a place.
  std::pair<std::size_t, std::size_t> token(const std::string& text) {
    const auto ends = [&](std::size_t k) {
      return std::string(" \t\r\n,[]{}:\"<>=").find(text[k]) != std::string::npos;
    };
    std::size_t from = below(text.size()), to = from;
    while (from > 0 && !ends(from - 1)) --from;
    while (to < text.size() && !ends(to)) ++to;
    return {from, to - from};
  }

  void change(std::string& text) {
    if (text.empty()) text = words[below(words.size())];
    const std::size_t at = below(text.size());
    switch (below(8)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, 1 + below(1 + below(64)));
        break;
      case 3:
        text.insert(at, std::string(stretch(text)));
        break;
      case 4: {
        const std::string& other = all_[below(all_.size())];
        if (!other.empty()) text.insert(at, std::string(stretch(other)));
        break;
      }
      case 5: {
        const auto [from, length] = token(text);
        text.replace(from, length, words[below(words.size())]);
        break;
      }
      case 6: {
        const auto [from, length] = token(text);
        const auto [other, other_length] = token(text);
        text.replace(from, length, text.substr(other, other_length));
        break;
      }
      default:
        text.resize(at);
        break;
    }
  }

  const std::vector<std::string>& all_;
  std::mt19937_64 random_{seed};
};

}  // namespace

/// Replays inputs for compilers without libFuzzer. usage: replay RUNS FOLDER... It reads all files of the folders, then
/// RUNS changed ones, which are the same each time. It finds less than libFuzzer, since it does not measure the
/// branches that inputs reach.
int main(int count, char** words_of_line) {
  if (count < 3) return 2;
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, keep_input);
  const auto all = inputs_of(count - 2, words_of_line + 2);
  if (all.empty()) return 2;
  for (const std::string& one : all) {
    input = one;
    read_input();
  }
  Mutator mutator(all);
  const long runs = std::atol(words_of_line[1]);
  for (long k = 0; k < runs; ++k) {
    input = mutator.next();
    read_input();
  }
  std::printf("%zu files and %ld changed ones\n", all.size(), runs);
}
