/// Writes a set of files as a run does, without the run: FOLDER NAME=TEXT... Without files it removes the set.
#include <cstdio>
#include <string>

#include "output_folder.hpp"

int main(int count, char** words) {
  using namespace probewright;
  app::Output output;
  output.folder = words[1];
  for (int i = 2; i < count; ++i) {
    const std::string word = words[i];
    const std::size_t equals = word.find('=');
    output.files.emplace_back(word.substr(0, equals),
                              [text = word.substr(equals + 1)](const Sink& sink) { sink(text); });
  }
  const Result<void> done = count > 2 ? app::writeOutput(output, {}) : app::removeEarlierRun(output.folder, {}, {});
  if (done) return 0;
  std::fputs((format(done.error()) + "\n").c_str(), stderr);
  return 2;
}
