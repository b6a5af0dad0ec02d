#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/sinumerik/data_store.hpp"

/// The control's initialization text: data as assignments, one or more a line (files _INI, TOA, UFR, GUD, SEA).
///
///     CHANDATA(1)
///     N10 $TC_DP3[1,1]=120.5           ; length 1
///     $P_UIFR[1]=CTRANS(X,10,Y,5):CROT(Z,3)
///     $P_UIFR[2,X,TR]=-12.75
///     M17
namespace probewright::control::sinumerik {

/// An initialization text as it was read. Nothing of it is lost: comments, block numbers, spacing, and everything that
/// isn't understood are in the text written back.
class InitText {
public:
  /// Reads the values of `channel` into `store`. Values are numbers (decimal, with exponent EX, 'H..' or 'B..'), TRUE,
  /// FALSE, strings, SET(...) lists that fill consecutive elements, and chains of frame functions with constants.
  /// To `diagnostics`: errors where an assignment is malformed (the rest of its line is skipped), notes for statements
  /// that have no meaning here. Never fails as a whole: what could be read is in the store.
  /// `sizes` tells the elements per dimension of an array, by its name in capitals: a list that is longer than its row
  /// goes on in the next one. Without them it fills the last index alone.
  using ArraySizes = std::function<std::vector<int>(std::string_view name)>;
  static InitText parse(std::string_view bytes, std::string file, DataStore& store, Diagnostics& diagnostics,
                        int channel = 1, const ArraySizes& sizes = {});

  /// The text as it was read.
  std::string bytes() const;

  /// The data that it gives values to.
  std::set<DataKey> keys() const;

  /// The text with the values of `store`: an assignment is rewritten only if one of its values differs, the last one
  /// where a datum is assigned more than once. Data that the text doesn't mention come before the end (M17, M30, M2,
  /// RET) of the channel, one a line. Error for a string that the language cannot hold (a quotation mark, a line
  /// break). Of the data that the text doesn't mention those are added that `accepts` accepts (without it: all), so
  /// that a control can keep tool data, frames and setting data in files of their own.
  using Accepts = std::function<bool(const DataKey&)>;
  Result<std::string> updated(const DataStore& store, const Accepts& accepts = {}) const;

private:
  enum class Form { Single, List, FrameChain };
  struct Assignment {
    std::size_t line = 0, begin = 0, end = 0;  ///< place of the value in the line
    Form form = Form::Single;
    DataKey frame;  ///< for a chain of frame functions
    std::vector<std::pair<DataKey, DataValue>> values;
  };
  class Reader;

  std::vector<std::string> lines_;  ///< with their line ends
  std::vector<Assignment> assignments_;
  std::size_t insertLine_ = 0;  ///< new data go before this line
  std::string newSection_;      ///< CHANDATA line that new data need first; may be empty
};

/// The number that the whole of `text` writes: "12.5", "-3EX-2", "'HFF'", "'B101'"; nothing if it is none or too large.
std::optional<double> parseNumber(std::string_view text);

}  // namespace probewright::control::sinumerik
