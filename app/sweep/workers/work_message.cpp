#include "app/sweep/workers/work_message.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace kinetix::app {
namespace {

template <class Value>
void put(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
void put_all(std::string& bytes, const Value* values, std::size_t count) {
  put(bytes, count);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class Value>
  Value get() {
    Value value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }

  template <class Container>
  Container get_all() {
    Container values(get<std::size_t>(), typename Container::value_type{});
    const std::size_t size = values.size() * sizeof(typename Container::value_type);
    if (const char* from = take(size); size > 0) std::memcpy(values.data(), from, size);
    return values;
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("a message of a sweep was cut short");
    const char* at = bytes_.data();
    bytes_.remove_prefix(size);
    return at;
  }

  std::string_view bytes_;
};

void put(std::string& bytes, const SampleRow& row) {
  put(bytes, row.sample);
  put_all(bytes, row.factors.data(), row.factors.size());
  put_all(bytes, row.responses.data(), row.responses.size());
  put(bytes, row.status);
  put_all(bytes, row.reason.data(), row.reason.size());
}

SampleRow get_row(Reader& reader) {
  SampleRow row;
  row.sample = reader.get<std::int64_t>();
  row.factors = reader.get_all<std::vector<double>>();
  row.responses = reader.get_all<std::vector<double>>();
  row.status = reader.get<SampleStatus>();
  row.reason = reader.get_all<std::string>();
  return row;
}

}  // namespace

std::string to_bytes(const WorkRequest& request) {
  std::string bytes;
  put(bytes, request.wanted);
  put_all(bytes, request.farewell.data(), request.farewell.size());
  put(bytes, request.rows.size());
  for (const SampleRow& row : request.rows) put(bytes, row);
  return bytes;
}

std::string to_bytes(const std::vector<std::int64_t>& samples) {
  std::string bytes;
  put_all(bytes, samples.data(), samples.size());
  return bytes;
}

WorkRequest read_request(std::string_view bytes) {
  Reader reader(bytes);
  WorkRequest request;
  request.wanted = reader.get<std::size_t>();
  request.farewell = reader.get_all<std::string>();
  request.rows.resize(reader.get<std::size_t>());
  for (SampleRow& row : request.rows) row = get_row(reader);
  return request;
}

std::vector<std::int64_t> read_samples(std::string_view bytes) {
  return Reader(bytes).get_all<std::vector<std::int64_t>>();
}

void work_for(const SweepPlan& plan, int threads,
              const std::function<std::string(const std::string&)>& exchange,
              const std::function<void(const std::string&)>& tell) {
  std::vector<SampleRow> rows;
  WorkRequest farewell;
  const WorkSource source = {
      [&](std::size_t count) {
        return read_samples(exchange(to_bytes(WorkRequest{std::exchange(rows, {}), count})));
      },
      [&](std::vector<SampleRow> more) {
        if (rows.empty())
          rows = std::move(more);
        else
          std::move(more.begin(), more.end(), std::back_inserter(rows));
      }};
  try {
    run_on_threads(plan, threads, source);
  } catch (const std::exception& e) {
    farewell.farewell = e.what();
  }
  farewell.rows = std::move(rows);
  tell(to_bytes(farewell));
}

}  // namespace kinetix::app
