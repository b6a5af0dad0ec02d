#include "session/sinumerik/global_data.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "base/file.hpp"

namespace probewright::session::sinumerik {

namespace fs = std::filesystem;

execution::sinumerik::GlobalUserData globalUserData(const fs::path& program, const fs::path& tables,
                                                    Diagnostics& diagnostics) {
  execution::sinumerik::GlobalUserData data;
  std::set<std::string> read;
  const fs::path beside = program.parent_path();
  for (const fs::path& folder : {tables, beside.empty() ? fs::path(".") : beside}) {
    if (folder.empty()) continue;
    std::vector<std::pair<std::string, fs::path>> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      std::string name = execution::sinumerik::definitionFileName(entry->path().filename().string());
      if (!name.empty() && entry->is_regular_file()) files.emplace_back(std::move(name), entry->path());
    }
    std::ranges::sort(files);
    for (const auto& [name, path] : files) {
      if (!read.insert(name).second) continue;
      if (Result<std::string> text = readFile(path)) {
        data.read(path.lexically_normal().string(), std::move(*text), diagnostics);
      } else {
        diagnostics.push_back(text.error());
      }
    }
  }
  return data;
}

}  // namespace probewright::session::sinumerik
