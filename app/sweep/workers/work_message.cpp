#include "app/sweep/workers/work_message.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/io/bytes.hpp"

namespace kinetix::app {
namespace {

void put_row(std::string& bytes, const SampleRow& row) {
  put(bytes, row.sample);
  put_all(bytes, row.factors.data(), row.factors.size());
  put_all(bytes, row.responses.data(), row.responses.size());
  put(bytes, row.status);
  put_all(bytes, row.reason.data(), row.reason.size());
}

SampleRow get_row(ByteReader& reader) {
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
  for (const SampleRow& row : request.rows) put_row(bytes, row);
  return bytes;
}

std::string to_bytes(const std::vector<std::int64_t>& samples) {
  std::string bytes;
  put_all(bytes, samples.data(), samples.size());
  return bytes;
}

WorkRequest read_request(std::string_view bytes) {
  ByteReader reader(bytes);
  WorkRequest request;
  request.wanted = reader.get<std::size_t>();
  request.farewell = reader.get_all<std::string>();
  request.rows.resize(reader.get<std::size_t>());
  for (SampleRow& row : request.rows) row = get_row(reader);
  return request;
}

std::vector<std::int64_t> read_samples(std::string_view bytes) {
  return ByteReader(bytes).get_all<std::vector<std::int64_t>>();
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
