#pragma once

#include <string>
#include <vector>

/// The pages of the documents, as text.
namespace probewright::app::testing {

/// A block of code: from ``` to ```, or indented by four blanks after a blank line.
struct CodeBlock {
  std::string page, text;
  std::size_t line = 0;
  std::string kind;  ///< what stands after ```: "text" for what a program prints, "json"
};

/// Those of README, CONTRIBUTING and all pages of docs, in their order.
std::vector<CodeBlock> codeBlocks();

}  // namespace probewright::app::testing
