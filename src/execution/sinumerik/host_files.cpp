#include <fmt/format.h>

#include <algorithm>

#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "execution/sinumerik/host.hpp"

/// Files that programs write, read and delete: WRITE, READ, DELETE, ISFILE.
namespace probewright::execution::sinumerik {

using control::Alarm;

namespace {

/// What READ and DELETE leave in their variable for the error.
enum class FileError { None = 0, NotFound = 3, NoSuchLine = 21, ResultTooSmall = 22, TooManyLines = 23 };

/// Steps of a search through the folders for a file that is not there.
constexpr std::uint64_t stepsOfSearch = 4 * Host::stepsOfFile(0);

std::string withoutFolders(std::string file) {
  if (const std::size_t folder = file.find_last_of("/\\"); folder != std::string::npos) file.erase(0, folder + 1);
  if (file.empty() || file == "." || file == "..")
    throw Alarm("14020", "the name of a file is missing", "name the file after its folders");
  return file;
}

/// The name by which files are compared: "PROT", "prot.mpf" and "/_N_WKS_DIR/_N_PROT_MPF" are one.
std::string comparedName(std::string file) {
  std::string name = upperCase(withoutFolders(std::move(file)));
  const bool archived = name.starts_with("_N_");
  if (archived) name.erase(0, 3);
  const std::size_t end = archived ? name.rfind('_') : std::string::npos;
  if (end != std::string::npos && end > 0) name[end] = '.';
  return name.find('.') == std::string::npos ? name + ".MPF" : name;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.pop_back();
    lines.push_back(std::move(line));
    at = end + 1;
  }
  return lines;
}

}  // namespace

/// What programs of this run wrote into a file; null if nothing.
const std::string* SinumerikHost::writtenFile(const std::string& name) const {
  for (const auto& [each, text] : control_.panel.files())
    if (!text.empty() && comparedName(each) == name) return &text;
  return nullptr;
}

/// The text of a file as the program sees it: what lay there, and after it what was written in this run.
std::optional<std::string> SinumerikHost::fileText(const std::string& file) const {
  const std::string name = comparedName(file);
  std::optional<std::string> text;
  work_ += control_.panel.files().size();
  if (options_.readFile && !deletedFiles_.contains(name)) text = options_.readFile(file);
  if (const std::string* written = writtenFile(name)) {
    if (!text) text.emplace();
    if (!text->empty() && text->back() != '\n') *text += '\n';
    *text += *written;
  }
  work_ += text ? stepsOfFile(text->size()) : stepsOfSearch;
  return text;
}

bool SinumerikHost::isFile(const std::string& path) const {
  const std::string plain = path.substr(path.find_last_of("/\\") + 1);
  if (plain.empty() || plain == "." || plain == "..") return false;
  const std::string name = comparedName(path);
  work_ += stepsOfSearch + control_.panel.files().size();
  if (writtenFile(name) != nullptr) return true;
  if (deletedFiles_.contains(name)) return false;
  return (options_.fileExists && options_.fileExists(path)) || (options_.readFile && options_.readFile(path));
}

void SinumerikHost::setVariable(const Operand& target, const Value& value, Evaluation& evaluation) {
  if (target.node < 0) return;
  const Node& node = evaluation.block().nodes[static_cast<std::size_t>(target.node)];
  if (node.operation == Operation::Variable) write(evaluation.block().variables[node.a], value, evaluation);
}

/// WRITE(ERROR, "FILE", "text"): appends a line.
void SinumerikHost::writeFile(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  if (words.size() < 3 || !words[2].value.present() || words[0].value.node < 0)
    throw Alarm("14020", "WRITE takes a variable for the error, a file and a text",
                "write WRITE(ERR,\"FILE\",\"text\")");
  const std::string file = withoutFolders(evaluation.text(words[1].value));
  control_.panel.appendToFile(file, evaluation.text(words[2].value) + "\n");
  setVariable(words[0].value, 0.0, evaluation);
}

/// READ(ERROR, "FILE", line, count, RESULT): `count` lines from `line` on into the elements of RESULT; line 0 means the
/// last ones.
void SinumerikHost::readFile(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  const auto isVariable = [&](const Operand& operand) {
    return operand.node >= 0 &&
           evaluation.block().nodes[static_cast<std::size_t>(operand.node)].operation == Operation::Variable;
  };
  if (words.size() < 5 || !isVariable(words[0].value) || !words[1].value.present() || !isVariable(words[4].value))
    throw Alarm("14020", "READ takes a variable for the error, a file, a line, a number of lines and a STRING variable",
                "write READ(ERR,\"FILE\",1,1,RESULT) with DEF STRING[255] RESULT");
  const auto leave = [&](FileError error) { setVariable(words[0].value, static_cast<double>(error), evaluation); };
  const std::optional<std::string> text = fileText(evaluation.text(words[1].value));
  if (!text) return leave(FileError::NotFound);
  const std::vector<std::string> lines = linesOf(*text);
  const double first = evaluation.numberOr(words[2].value, 0), count = evaluation.numberOr(words[3].value, 1);
  const auto all = static_cast<double>(lines.size());
  if (!(first >= 0 && first <= all) || count < 1) return leave(FileError::NoSuchLine);
  if (first == 0 ? count > all : first - 1 + count > all) return leave(FileError::TooManyLines);
  const auto begin = static_cast<std::size_t>(first == 0 ? all - count : first - 1);

  const Node& node = evaluation.block().nodes[static_cast<std::size_t>(words[4].value.node)];
  const VariableRef& variable = evaluation.block().variables[node.a];
  UserVariable* user = variable.space == VariableSpace::User ? variables_.find(evaluation.at(variable.name)) : nullptr;
  if (user == nullptr || user->type() != Type::String)
    throw Alarm("12150", "the lines that READ finds go into a STRING variable", "define DEF STRING[255] RESULT");
  double indices[3];
  std::size_t given = 0;
  for (const Operand& index : variable.index)
    if (index.present()) indices[given++] = evaluation.number(index);
  const bool whole = user->isArray() && given == 0;
  std::size_t place = whole ? std::size_t{0} : user->place(evaluation.at(variable.name), {indices, given});
  const std::size_t room = whole ? user->count() : 1;
  if (count > static_cast<double>(room)) return leave(FileError::ResultTooSmall);
  bool cut = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i, ++place) {
    const std::string& line = lines[begin + i];
    user->set(place, line);
    cut = cut || std::get<std::string>(user->at(place)) != line;
  }
  leave(cut ? FileError::ResultTooSmall : FileError::None);
}

/// DELETE(ERROR, "FILE"): from here on the program finds the file no more. What lies on this computer stays.
void SinumerikHost::deleteFile(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  if (words.size() < 2 || !words[1].value.present())
    throw Alarm("14020", "DELETE takes a variable for the error and a file", "write DELETE(ERR,\"FILE\")");
  const std::string file = evaluation.text(words[1].value), name = comparedName(file);
  const bool there = isFile(file);
  std::vector<std::string> written;
  for (const auto& [each, text] : control_.panel.files())
    if (comparedName(each) == name) written.push_back(each);
  for (const std::string& each : written)
    control_.panel.file(each, {});
  if (there) deletedFiles_.insert(name);
  setVariable(words[0].value, static_cast<double>(there ? FileError::None : FileError::NotFound), evaluation);
}

}  // namespace probewright::execution::sinumerik
