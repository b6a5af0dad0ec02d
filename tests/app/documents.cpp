#include "app/documents.hpp"

#include <filesystem>
#include <sstream>

#include "app/program.hpp"

namespace probewright::app::testing {

std::vector<CodeBlock> codeBlocks() {
  std::vector<std::filesystem::path> pages = {std::string(PROBEWRIGHT_SOURCE_DIR) + "/README.md",
                                              std::string(PROBEWRIGHT_SOURCE_DIR) + "/CONTRIBUTING.md"};
  for (const std::string& name : namesIn(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs"))
    if (name.ends_with(".md")) pages.push_back(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/" + name);
  for (const std::string& name : namesIn(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/decisions"))
    pages.push_back(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/decisions/" + name);
  std::vector<CodeBlock> blocks;
  for (const auto& page : pages) {
    std::istringstream stream(textOf(page));
    bool fenced = false, indented = false, blank = true;
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (line.starts_with("```")) {
        fenced = !fenced;
        if (fenced) blocks.push_back({page.filename(), "", number, line.substr(3)});
        continue;
      }
      if (fenced) {
        blocks.back().text += line + "\n";
        continue;
      }
      const bool code = line.starts_with("    ") && (indented || blank);
      if (code && !indented) blocks.push_back({page.filename(), "", number, ""});
      indented = code;
      if (code) blocks.back().text += line.substr(4) + "\n";
      blank = line.empty();
    }
  }
  return blocks;
}

}  // namespace probewright::app::testing
