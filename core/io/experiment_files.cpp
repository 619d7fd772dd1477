// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/experiment_files.h"

#include <system_error>

#include <nlohmann/json.hpp>

#include "core/base/check.h"
#include "core/io/atomic_file.h"
#include "core/io/json_text.h"
#include "core/io/result_folder.h"

namespace gyre {

std::string csvOf(const ExperimentTable& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += (i > 0 ? "," : "") + table.columns[i].key;
  }
  text += '\n';
  for (const auto& row : table.rows) {
    GYRE_CHECK(row.size() == table.columns.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ',';
      if (row[i]) text += jsonNumber(*row[i]);
    }
    text += '\n';
  }
  return text;
}

std::string jsonOf(const ExperimentTable& table) {
  nlohmann::ordered_json root;
  root["name"] = table.name;
  root["caption"] = table.caption;
  for (const ExperimentColumn& column : table.columns) root["columns"][column.key] = column.label;
  root["rows"] = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    GYRE_CHECK(row.size() == table.columns.size());
    nlohmann::ordered_json line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line[table.columns[i].key] = row[i] ? nlohmann::ordered_json(*row[i]) : nullptr;
    }
    root["rows"].push_back(std::move(line));
  }
  return root.dump(2) + "\n";
}

Result<void> writeExperiment(const std::filesystem::path& folder, const ExperimentTable& table) {
  if (const auto made = makeResultFolder(folder); !made) return made.error();
  const struct {
    const char* ending;
    std::string text;
  } files[] = {{".csv", csvOf(table)}, {".json", jsonOf(table)}, {".svg", svgOf(table)}};
  for (const auto& file : files) {
    const auto written = writeFileAtomically(folder / (table.name + file.ending), file.text);
    if (!written) return written;
  }
  return {};
}

}  // namespace gyre
