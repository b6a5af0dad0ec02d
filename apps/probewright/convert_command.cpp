#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "base/file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "session/convert.hpp"
#include "session/job.hpp"
#include "setup/setup.hpp"

namespace probewright::app {

namespace {

/// Why OUT must not be written; empty if nothing speaks against it. Files are told apart by what they are, not by their
/// names: a link to IN is IN, and so is `new/../IN`, although the folder `new` is made only when OUT is written.
std::optional<Diagnostic> objectionTo(const ConvertArguments& arguments) {
  const auto objection = [&](std::string message, std::string advice) {
    return Diagnostic{
        Severity::Error, {arguments.output.string(), 0, 0}, std::move(message), {}, std::move(advice), {}};
  };
  std::error_code none;
  std::filesystem::path output = std::filesystem::weakly_canonical(arguments.output, none);
  if (none || output.empty()) output = arguments.output;
  const auto same = [&](const std::filesystem::path& other) {
    return !other.empty() && std::filesystem::equivalent(output, other, none) && !none;
  };
  if (same(arguments.input)) return objection("OUT is the program itself", "give OUT another name");
  if (same(arguments.setup)) return objection("OUT is the setup", "give OUT another name");
  const auto there = std::filesystem::symlink_status(arguments.output, none);
  if (std::filesystem::is_directory(output, none)) {
    return objection("OUT is a folder", "give the name of a file");
  }
  if ((std::filesystem::exists(there) || std::filesystem::exists(output, none)) && !arguments.force) {
    return objection("the file exists already", "give OUT another name, or overwrite it with --force");
  }
  return std::nullopt;
}

conversion::ToolCycles formOf(const std::string& word) {
  return word == "old"   ? conversion::ToolCycles::Old
         : word == "new" ? conversion::ToolCycles::New
                         : conversion::ToolCycles::AsWritten;
}

}  // namespace

int convert(const ConvertArguments& arguments) {
  const session::ControlFamilies& families = session::knownFamilies();
  const auto refuse = [](const Diagnostic& why) {
    print({why});
    return 2;
  };
  const Result<std::string> text = readFile(arguments.input);
  if (!text) return refuse(text.error());
  if (text->find_first_not_of(" \t\r\n\x1a\xEF\xBB\xBF") == std::string::npos) {
    return refuse({Severity::Error,
                   {arguments.input.string(), 0, 0},
                   "the program is empty",
                   {},
                   "check that the file was saved and copied whole",
                   {}});
  }
  const auto from = session::languageOf(arguments.input, *text);
  if (!from) {
    return refuse({Severity::Error,
                   {arguments.input.string(), 0, 0},
                   "neither the file extension nor the text shows the language of this program",
                   {},
                   fmt::format("give it an extension: {}", session::endingsOf(families)),
                   {}});
  }
  const auto to = session::languageOf(arguments.output, {});
  if (!to) {
    return refuse({Severity::Error,
                   {arguments.output.string(), 0, 0},
                   "the file extension does not show the language to convert to",
                   {},
                   fmt::format("end the name with {}", session::endingsWithLanguages(families)),
                   {}});
  }
  if (!arguments.toolCycles.empty() && !conversion::hasToolCycleForms(*to)) {
    return refuse({Severity::Error,
                   {arguments.output.string(), 0, 0},
                   fmt::format("{} has one form of the tool measuring cycles", families.entry(*to).name),
                   {},
                   "leave --tool-cycles out, or write Klartext (.H)",
                   {}});
  }
  if (!conversion::convertible(*from, *to)) {
    return refuse({Severity::Error,
                   {arguments.input.string(), 0, 0},
                   fmt::format("the program is one of {} already", families.entry(*from).name),
                   {},
                   fmt::format("name a file with the extension of another language: {}", session::endingsOf(families)),
                   {}});
  }
  if (const auto objection = objectionTo(arguments)) return refuse(*objection);
  Diagnostics found;
  std::optional<setup::Setup> setup;
  if (!arguments.setup.empty()) {
    setup = setup::readSetup(arguments.setup, found);
    if (!setup) {
      print(found);
      return 2;
    }
  }
  conversion::ConvertOptions options =
      session::convertOptions(arguments.input, *from, setup ? &setup->beliefs : nullptr, found);
  print(found);
  if (hasErrors(found)) return 2;
  if (arguments.control && !families.speaks(*arguments.control, *to)) {
    return refuse({Severity::Error,
                   {arguments.output.string(), 0, 0},
                   fmt::format("the {} does not read {}", control::name(*arguments.control), families.entry(*to).name),
                   {},
                   "leave --control out, or name a control of the language of OUT",
                   {}});
  }
  const auto program = session::openProgram(arguments.input, *text, *from);
  if (!program) return refuse(program.error());
  const language::Encoding encoding = language::detectEncoding(*text);
  Diagnostics mistakes = session::mistakesOf(**program, arguments.input, *from, setup ? &setup->beliefs : nullptr);
  if (hasErrors(mistakes)) {
    std::erase_if(mistakes, [&](const Diagnostic& each) {  // what has been said
      return std::ranges::any_of(found, [&](const Diagnostic& said) { return format(said) == format(each); });
    });
    print(mistakes, encoding);
    if (const auto note = session::otherLanguage(arguments.input, *text)) print({*note});
    return 2;
  }
  const conversion::Job job = session::jobOf(arguments.input, *from);
  options.control = arguments.control.value_or(families.of(*to).controls.front().kind);
  options.job = &job;
  options.probe = {.setUp = arguments.setUp, .travel = arguments.dist};
  options.toolCycles = formOf(arguments.toolCycles);
  const conversion::Conversion conversion = conversion::convert(**program, *from, *to, options);
  if (hasErrors(conversion.mistakes)) {
    print(conversion.mistakes, encoding);
    return 2;
  }
  if (const Result<void> written = writeFileAtomically(arguments.output, conversion.text); !written) {
    return refuse(written.error());
  }
  print(conversion.notCarriedOver, encoding);
  const bool doubtful = std::ranges::any_of(conversion.notCarriedOver,
                                            [](const Diagnostic& each) { return each.severity != Severity::Note; });
  return doubtful ? 1 : 0;
}

}  // namespace probewright::app
