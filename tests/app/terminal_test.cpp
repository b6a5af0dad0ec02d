#include "terminal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

#include "app/program.hpp"

/// Texts as wide as the terminal.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    while (!line.empty() && line.back() == '\r')
      line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

/// What the program shows on a terminal of this many columns.
std::string onTerminal(const std::vector<std::string>& words, unsigned short columns) {
  winsize size{};
  size.ws_row = 50;
  size.ws_col = columns;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    std::vector<std::string> all{PROBEWRIGHT_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    for (std::string& word : all)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (chdir(PROBEWRIGHT_SOURCE_DIR) != 0) _exit(127);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  std::string shown;
  char bytes[4096];
  for (ssize_t count = 0; (count = read(terminal, bytes, sizeof bytes)) > 0;)
    shown.append(bytes, static_cast<std::size_t>(count));
  close(terminal);
  waitpid(child, nullptr, 0);
  return shown;
}

TEST(Terminal, BreaksLinesBelowTheSecondColumn) {
  EXPECT_EQ(fitted("  --out DIR     The folder for tables and logs of the run\n", 40),
            "  --out DIR     The folder for tables\n                and logs of the run\n");
  // Of two places the one between columns.
  EXPECT_EQ(fitted("      Q153  diameter  30.0100 mm   deviation +0.0100  OK\n", 40),
            "      Q153  diameter  30.0100 mm\n            deviation +0.0100  OK\n");
  // A second column that begins in the middle still counts, one further on does not.
  EXPECT_EQ(fitted("  --option-name     The folder for tables and logs\n", 40),
            "  --option-name     The folder for\n                    tables and logs\n");
  EXPECT_EQ(fitted("  a description that is long enough  and then a second\n", 40),
            "  a description that is long enough\n      and then a second\n");
  EXPECT_EQ(fitted("a.h:3:4: error: the cycle lacks a parameter\n", 30),
            "a.h:3:4: error: the cycle\n    lacks a parameter\n");
}

TEST(Terminal, LeavesWhatFits) {
  const std::string text = "one two three\n\n  four\nno line feed at the end";
  EXPECT_EQ(fitted(text, 0), text) << "not a terminal";
  EXPECT_EQ(fitted(text, 80), text);
  EXPECT_EQ(fitted("12345678901234567890\n", 20), "12345678901234567890\n");
  const std::string word(60, 'x');
  EXPECT_EQ(fitted(word + "\n", 30), word + "\n") << "a word stays whole";
}

TEST(Terminal, CountsCharactersNotBytes) {
  const std::string umlauts =
      "\xC3\xA4\xC3\xB6\xC3\xBC \xC3\xA4\xC3\xB6\xC3\xBC "
      "\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC";
  EXPECT_EQ(fitted(umlauts, 20), umlauts);
  const std::string red = "\033[31mred\033[0m one two three four";
  EXPECT_EQ(fitted(red, 22), red);
  EXPECT_EQ(fitted(red, 21), "\033[31mred\033[0m one two three\n    four");
  const std::string cut = "12345678901234567890\033[3";
  EXPECT_EQ(fitted(cut, 20), cut) << "a colour that is cut off takes no column either";
}

TEST(Terminal, IsFilledNotOverrun) {
  const Folder folder;
  const std::vector<std::string> commands[] = {
      {"run", "--help"},
      {"cycles"},
      {"cycles", "CYCLE998"},
      {"check", folder.file("a.h", "0 BEGIN PGM A MM\n1 TCH PROBE 412 X ~\nQ321=+1\n2 END PGM A MM\n")},
      {"run", "examples/first/plate.h", "--setup", "examples/first/plate.toml", "--out", (folder / "out").string()}};
  for (const auto& command : commands) {
    SCOPED_TRACE(command.front() + " " + command.back());
    std::size_t longest = 0;
    for (const std::string& line : linesOf(onTerminal(command, 200)))
      longest = std::max(longest, line.size());
    EXPECT_GT(longest, 72U) << "otherwise nothing is shown";
    for (std::string line : linesOf(onTerminal(command, 72))) {
      for (std::size_t at = line.find('\033'); at != std::string::npos; at = line.find('\033'))
        line.erase(at, line.find_first_of("mK", at) + 1 - at);
      const bool oneWord = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
      EXPECT_TRUE(line.size() <= 72 || oneWord || line.find('/') != std::string::npos) << line;
    }
  }
  // Into a file nothing is broken.
  EXPECT_THAT(
      probewright({"cycles", "CYCLE998"}).output,
      HasSubstr("Measures the angle of an edge by two points, or of a plane by three, and turns the zero offset, "
                "or shifts a rotary axis, so that it has its set angle.\n"));
}

}  // namespace
}  // namespace probewright::app::testing
