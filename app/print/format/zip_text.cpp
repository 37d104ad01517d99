#include "app/print/format/zip_text.hpp"

#include <zip.h>

#include <stdexcept>

namespace kinetix::app {
namespace {

// 1980-01-01 in local time, the first day of zip: the times of files would make archives differ.
constexpr zip_uint16_t first_day = (1 << 5) | 1;

void check(bool fine, const char* what) {
  if (!fine) throw std::runtime_error(std::string("zip archive: ") + what);
}

void add(zip_t* archive, const NamedContent& file) {
  zip_source_t* source = zip_source_buffer(archive, file.content.data(), file.content.size(), 0);
  check(source != nullptr, "no memory");
  const zip_int64_t index = zip_file_add(archive, file.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  check(index >= 0, "a file cannot be added");
  check(zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, first_day, 0) == 0,
        "a file's time cannot be set");
}

std::string content_of(zip_source_t* source) {
  zip_stat_t status;
  check(zip_source_stat(source, &status) == 0 && zip_source_open(source) == 0, "it cannot be read back");
  std::string out(status.size, '\0');
  const zip_int64_t read = zip_source_read(source, out.data(), out.size());
  zip_source_close(source);
  check(read == static_cast<zip_int64_t>(out.size()), "it cannot be read back");
  return out;
}

}  // namespace

std::string zip_text(const std::vector<NamedContent>& files) {
  zip_error_t error;
  zip_error_init(&error);
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> source(
      zip_source_buffer_create(nullptr, 0, 0, &error), &zip_source_free);
  check(source != nullptr, "no memory");
  zip_t* archive = zip_open_from_source(source.get(), ZIP_TRUNCATE, &error);
  check(archive != nullptr, "it cannot be opened");
  zip_source_keep(source.get());
  for (const NamedContent& file : files) add(archive, file);
  check(zip_close(archive) == 0, "it cannot be written");
  return content_of(source.get());
}

std::string text_in_zip(const std::string& archive, const std::string& name) {
  const std::unique_ptr<zip_t, decltype(&zip_discard)> opened(zip_open(archive.c_str(), ZIP_RDONLY, nullptr),
                                                              &zip_discard);
  zip_stat_t status;
  if (!opened || zip_stat(opened.get(), name.c_str(), 0, &status) != 0) return {};
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(zip_fopen(opened.get(), name.c_str(), 0),
                                                                &zip_fclose);
  if (!file) return {};
  std::string out(status.size, '\0');
  const zip_int64_t read = zip_fread(file.get(), out.data(), out.size());
  out.resize(read > 0 ? static_cast<std::size_t>(read) : 0);
  return out;
}

}  // namespace kinetix::app
