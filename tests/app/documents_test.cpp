#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "app/documents.hpp"
#include "app/program.hpp"

/// What the documents promise of the program, held against the program.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string root = PROBEWRIGHT_SOURCE_DIR;

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator each(text.begin(), text.end(), expression), end; each != end; ++each)
    found.insert((*each)[1]);
  return found;
}

/// The part of a page from the line that begins with `head` up to the next heading of that level.
std::string section(const std::string& page, const std::string& head) {
  const std::size_t begin = page.find("\n" + head);
  if (begin == std::string::npos) {
    ADD_FAILURE() << "no section " << head;
    return {};
  }
  const std::size_t end = page.find("\n## ", begin + 1);
  return page.substr(begin, end - begin);
}

TEST(Documents, NameEveryOptionAndNoOther) {
  const std::string page = textOf(root + "/docs/command-line.md");
  for (const char* command :
       {"run", "check", "compare", "convert", "cycles", "project", "feel", "camera", "machine", "study", "survive"}) {
    SCOPED_TRACE(command);
    const std::string part = section(page, std::string("## `probewright ") + command);
    std::string rows;
    std::istringstream stream(part);
    for (std::string line; std::getline(stream, line);)
      if (line.starts_with("| `--")) rows += line.substr(0, line.find(" | ", 2)) + "\n";
    std::set<std::string> known = matches(probewright({command, "--help"}).output, "\n  (--[a-z-]+)");
    EXPECT_EQ(matches(rows, "(--[a-z-]+)"), known);
  }
}

TEST(Documents, NameOptionsThatThereAre) {
  std::set<std::string> known = {"--help",  "--version", "--sanitize", "--preset",
                                 "--build", "--install", "--component"};
  for (const char* command :
       {"run", "check", "compare", "convert", "cycles", "project", "feel", "camera", "machine", "study", "survive"})
    for (const std::string& option : matches(probewright({command, "--help"}).output, "\n  (--[a-z-]+)"))
      known.insert(option);
  for (const std::string& name : namesIn(root + "/docs")) {
    if (!name.ends_with(".md")) continue;
    for (const std::string& option : matches(textOf(root + "/docs/" + name), "`[^`\n]*?(--[a-z][a-z-]+)"))
      EXPECT_TRUE(known.contains(option)) << name << ": " << option;
  }
  for (const std::string& option : matches(textOf(root + "/README.md"), "`[^`\n]*?(--[a-z][a-z-]+)"))
    EXPECT_TRUE(known.contains(option)) << "README.md: " << option;
}

TEST(Documents, NameTheDefaultsOfOptions) {
  const std::string help = probewright({"run", "--help"}).output;
  const std::string part = section(textOf(root + "/docs/command-line.md"), "## `probewright run");
  for (const std::string& option : matches(help, "\n  (--[a-z-]+) [^ \n]*=[^ \n]+")) {
    std::smatch shown, documented;
    ASSERT_TRUE(std::regex_search(help, shown, std::regex("\n  " + option + " [^ \n]*(?:\\[[^\\]]*\\])?=([^ \n]+)")));
    ASSERT_TRUE(std::regex_search(part, documented, std::regex("\\| `" + option + "` \\| `?([^|`]*[^|` ])`? \\|")))
        << option;
    EXPECT_EQ(documented[1], shown[1]) << option;
  }
  EXPECT_THAT(help, HasSubstr("--record-limit"));
  EXPECT_TRUE(std::regex_search(help, std::regex("--record-limit [^\n]*=96")));
  EXPECT_THAT(part, HasSubstr("| `--record-limit` | 96 |"));
}

TEST(Documents, NameTheExitCodes) {
  const std::string help = probewright({"--help"}).output;
  const std::string readme = textOf(root + "/README.md"), page = textOf(root + "/docs/command-line.md");
  const auto oneLine = [](std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
  };
  for (const char* each : {"0 fine", "1 measured and out of tolerance", "2 a mistake in the input",
                           "3 an alarm or a stop while running", "4 an error inside Probewright"}) {
    const std::string words = each;
    EXPECT_THAT(help, HasSubstr(words));
    EXPECT_THAT(oneLine(readme), HasSubstr(words));
    EXPECT_THAT(page, HasSubstr("| " + words.substr(0, 1) + " | " + words.substr(2)));
  }
}

TEST(Documents, ShowWhatTheFirstExamplePrints) {
  const Folder folder;
  const std::string readme = textOf(root + "/README.md");
  // The plate is the one of the file, and the output that of the program.
  const std::size_t toml = readme.find("```toml\n") + 8;
  const std::string file = textOf(root + "/examples/first/plate.toml");
  std::istringstream plate(readme.substr(toml, readme.find("```", toml) - toml));
  std::size_t from = 0;
  for (std::string line; std::getline(plate, line); from += line.size()) {
    from = file.find(line + "\n", from);
    ASSERT_NE(from, std::string::npos) << line;
  }
  const std::string command =
      "$ build/release/apps/probewright/probewright run examples/first/plate.h --setup "
      "examples/first/plate.toml --out out/plate\n";
  const std::size_t at = readme.find(command);
  ASSERT_NE(at, std::string::npos);
  const std::size_t begin = at + command.size();
  const std::string shown = readme.substr(begin, readme.find("```", begin) - begin);
  const Answer answer = probewright(
      {"run", "examples/first/plate.h", "--setup", "examples/first/plate.toml", "--out", (folder / "plate").string()});
  EXPECT_EQ(answer.exit, 1);
  std::istringstream stream(shown);
  int lines = 0;
  for (std::string line; std::getline(stream, line); ++lines)
    EXPECT_THAT(answer.output, HasSubstr(line + "\n"));
  EXPECT_GE(lines, 5);
}

TEST(Documents, ShowTheWayOutOfTheFirstExample) {
  // "Put a cycle 412 before it, and all three values are OK."
  const Folder folder;
  std::string program = textOf(root + "/examples/first/plate.h");
  const std::size_t measures = program.find("TCH PROBE 421");
  ASSERT_NE(measures, std::string::npos);
  const std::size_t lineBegin = program.rfind('\n', measures) + 1;
  program.insert(lineBegin,
                 "TCH PROBE 412 PRESET INSIDE CIRCLE ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\n"
                 "Q261=-5 ~\nQ320=+0 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\n"
                 "Q382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  const Answer answer = probewright({"run", folder.file("plate.h", program), "--setup",
                                     root + "/examples/first/plate.toml", "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("all 3 toleranced values are within the limits"));
}

/// Every block of code that is a table, a program, data or a mask is one that the program takes.
TEST(Documents, ShowCodeThatIsTaken) {
  const Folder folder;
  std::filesystem::create_directory(folder / "klartext");
  std::filesystem::create_directory(folder / "sinumerik");
  const std::string klartextSetup = folder.file("k.toml", "[control]\ntype = \"TNC640\"\ntables = \"klartext\"\n");
  const std::string sinumerikSetup = folder.file("s.toml", "[control]\ntype = \"840Dsl\"\ntables = \"sinumerik\"\n");
  int taken = 0;
  for (const CodeBlock& block : codeBlocks()) {
    SCOPED_TRACE(block.page + ":" + std::to_string(block.line) + "\n" + block.text);
    const auto runs = [&](const std::string& program, const std::string& setup) {
      const Answer answer = probewright({"run", program, "--setup", setup, "--out", (folder / "out").string()});
      EXPECT_EQ(answer.exit, 0) << answer.errors;
      EXPECT_EQ(answer.errors, "");
      ++taken;
    };
    const std::string empty = folder.file("empty.h", "0 BEGIN PGM EMPTY MM\n1 END PGM EMPTY MM\n");
    const std::string emptyToo = folder.file("empty.mpf", "M30\n");
    if (block.kind == "text" || block.text.starts_with("$ ")) {
      ++taken;
    } else if (block.kind == "json") {
      EXPECT_TRUE(nlohmann::json::accept(block.text));
      ++taken;
    } else if (block.text.starts_with("BEGIN TOOL.T")) {
      folder.file("klartext/TOOL.T", block.text);
      runs(empty, klartextSetup);
    } else if (block.text.starts_with("CHANDATA")) {
      folder.file("sinumerik/A.INI", block.text);
      runs(emptyToo, sinumerikSetup);
    } else if (block.text.starts_with("DEF NCK")) {
      folder.file("sinumerik/UGUD.DEF", block.text);
      runs(emptyToo, sinumerikSetup);
      std::filesystem::remove(folder / "sinumerik/UGUD.DEF");
    } else if (block.text.starts_with("PROC ")) {
      EXPECT_EQ(probewright({"check", folder.file("CUST_MEACYC.SPF", block.text)}).exit, 0);
      std::filesystem::remove(folder / "CUST_MEACYC.SPF");
      ++taken;
    } else if (block.text.starts_with("_MVAR")) {
      const Answer answer = probewright({"check", folder.file("old.mpf", block.text + "M30\n")});
      EXPECT_EQ(answer.exit, 0) << answer.errors;
      ++taken;
    } else if (block.text.starts_with("\"RESULT OF")) {
      folder.file("MASK.A", block.text);
      runs(folder.file("mask.h",
                       "0 BEGIN PGM MASK MM\n1 QS1 = \"BORE\"\n2 Q31 = 1.5\n3 FN 16: F-PRINT MASK.A / OUT.TXT\n"
                       "4 END PGM MASK MM\n"),
           klartextSetup);
      EXPECT_THAT(textOf(folder / "out" / "OUT.TXT"), HasSubstr("RESULT OF BORE\nX =     1.500\n"));
    } else if (block.text.starts_with("-> {")) {
      // Lines of the protocol of machine adapters.
      std::istringstream lines(block.text);
      for (std::string line; std::getline(lines, line);) {
        const auto message = nlohmann::json::parse(line.substr(3), nullptr, false);
        EXPECT_TRUE(message.is_object() && (message.contains("id") || message.contains("alive"))) << line;
      }
      ++taken;
    } else if (block.text.starts_with("CYCLE150")) {
      ++taken;  // a PROC line with the names of its arguments
    } else if (block.page == "heidenhain-cycles.md" && block.text.starts_with("sqrt(")) {
      ++taken;  // a formula
    } else {
      // Those of documented_blocks_test.cpp.
      EXPECT_THAT(block.kind, ::testing::AnyOf("toml", "ini", "hal", "sh", "cpp", "klartext", "sinumerik"))
          << "a kind of code that no test takes";
    }
  }
  EXPECT_GE(taken, 8);
}

/// Commands on the shipped examples, and those that need no file: in blocks of code and within lines. Long ones do
/// less.
TEST(Documents, PrintCommandsThatRun) {
  std::set<std::string> commands;
  const auto collect = [&](std::string text) {
    text = std::regex_replace(text, std::regex(R"(\\\n\s*)"), " ");
    const std::regex command(
        R"((?:^|\n)(?:\$ )?(?:build/release/apps/probewright/)?probewright ((?:run|check|study|survive|convert|cycles|machine|compare) [^\n#]*))");
    for (std::sregex_iterator each(text.begin(), text.end(), command), end; each != end; ++each)
      commands.insert((*each)[1]);
  };
  for (const CodeBlock& block : codeBlocks())
    collect(block.text);
  for (const std::string& name : namesIn(root + "/docs")) {
    if (!name.ends_with(".md")) continue;
    for (const std::string& code : matches(textOf(root + "/docs/" + name), "`(probewright [a-z][^`\n]*)`"))
      collect(code);
  }
  int ran = 0;
  for (const std::string& command : commands) {
    std::istringstream stream(command);
    std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    const auto isPlaceholder = [](const std::string& word) {
      return std::regex_match(word, std::regex(R"(\[?[A-Z]{2,}[A-Z.]*\]?|\.\.\.|.*=RANGE)"));
    };
    const auto isFile = [](const std::string& word) {
      return std::regex_search(word, std::regex(R"(\.(h|i|mpf|toml|ini|json|step)$)"));
    };
    const bool shipped = std::ranges::all_of(
        words, [&](const std::string& word) { return !isFile(word) || std::filesystem::exists(root + "/" + word); });
    if (!shipped || std::ranges::any_of(words, isPlaceholder) || words.size() < 2) continue;
    if (words[0] != "cycles" && !isFile(words[1])) continue;  // an option by its name
    SCOPED_TRACE("probewright " + command);
    const Folder folder;
    for (std::string& word : words)
      if (isFile(word)) word = root + "/" + word;
    const auto out = std::ranges::find(words, "--out");
    if (out != words.end()) words.erase(out, out + 2);
    if (words[0] == "run" || words[0] == "study" || words[0] == "survive")
      words.insert(words.end(), {"--out", (folder / "out").string()});
    if (words[0] == "machine") words.insert(words.end(), {"--out", (folder / "machine.html").string()});
    const auto fewer = [&](const char* option, const char* number) {
      const auto given = std::ranges::find(words, option);
      if (given != words.end()) words.erase(given, given + 2);
      words.insert(words.end(), {option, number});
    };
    if (words[0] == "study") fewer("--trials", "8");
    if (words[0] == "survive") {
      fewer("--samples", "8");
      fewer("--boxes", "20");
    }
    const Answer answer = probewright(words);
    EXPECT_TRUE(answer.exit == 0 || answer.exit == 1) << answer.exit << answer.errors;
    EXPECT_NE(answer.output, "");
    ++ran;
  }
  EXPECT_GE(ran, 6);
}

/// What is inside of the program and why stands on the pages for developers.
TEST(Documents, ForUsersNameNoSources) {
  const std::set<std::string> developers = {"code-overview.md", "metrology.md", "machine-adapters.md"};
  int pages = 0;
  for (const std::string& name : namesIn(root + "/docs")) {
    if (!name.ends_with(".md") || developers.contains(name)) continue;
    ++pages;
    const std::string page = textOf(root + "/docs/" + name);
    EXPECT_THAT(page, Not(HasSubstr("`src/"))) << name;
    EXPECT_THAT(page, Not(::testing::ContainsRegex("\\([a-z_]+\\.hpp\\)"))) << name;
  }
  EXPECT_GT(pages, 25);
}

TEST(Documents, LinkToPagesThatThereAre) {
  std::vector<std::filesystem::path> pages = {root + "/README.md", root + "/CONTRIBUTING.md",
                                              root + "/bench/README.md"};
  for (const std::string& name : namesIn(root + "/docs"))
    if (name.ends_with(".md")) pages.push_back(root + "/docs/" + name);
  for (const std::string& name : namesIn(root + "/docs/decisions"))
    pages.push_back(root + "/docs/decisions/" + name);
  const auto anchor = [](const std::string& heading) {
    std::string text;
    for (const char c : heading) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) text += static_cast<char>(std::tolower(c));
      if (c == ' ' || c == '-') text += '-';
    }
    return text;
  };
  int links = 0;
  for (const auto& page : pages) {
    for (const std::string& link : matches(textOf(page), "\\]\\(([^)]+)\\)")) {
      if (link.starts_with("http")) continue;
      ++links;
      const std::string file = link.substr(0, link.find('#'));
      const std::filesystem::path target = file.empty() ? page : page.parent_path() / file;
      ASSERT_TRUE(std::filesystem::exists(target)) << page << ": " << link;
      if (link.find('#') == std::string::npos) continue;
      std::set<std::string> anchors;
      for (const std::string& heading : matches("\n" + textOf(target), "\n#+ ([^\n]+)"))
        anchors.insert(anchor(heading));
      EXPECT_TRUE(anchors.contains(link.substr(link.find('#') + 1))) << page << ": " << link;
    }
  }
  EXPECT_GT(links, 50);
  // And the list of pages has all of them.
  const std::string list = textOf(root + "/docs/README.md");
  for (const std::string& name : namesIn(root + "/docs")) {
    if (name.ends_with(".md") && name != "README.md") {
      EXPECT_THAT(list, HasSubstr("](" + name + ")"));
    }
  }
  for (const std::string& name : namesIn(root + "/docs/decisions"))
    EXPECT_THAT(list, HasSubstr("](decisions/" + name + ")"));
}

}  // namespace
}  // namespace probewright::app::testing
