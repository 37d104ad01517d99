#include "tests/app/schema_errors.hpp"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "tests/app/program.hpp"

namespace kinetix::testing {

std::string schema_errors(const nlohmann::json& document, const std::string& name) {
  const nlohmann::json schema_json =
      nlohmann::json::parse(text_of(KINETIX_SOURCE "/app/schema/" + name + ".schema.json"));
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults errors;
  valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &errors);
  std::string text;
  for (const auto& error : errors) {
    for (const auto& part : error.context) text += part;
    text += ": " + error.description + "\n";
  }
  return text;
}

}  // namespace kinetix::testing
