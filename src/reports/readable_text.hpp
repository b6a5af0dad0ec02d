#pragma once

#include <string>

namespace probewright::reports {

/// `bytes` of a program file as UTF-8 for showing: UTF-8 stays as it is; otherwise the encoding is guessed among those
/// that programs are written in (CP1252, CP1250, CP1251, GBK) from the letters that stand there. Never fails; a byte
/// that has no meaning becomes U+FFFD.
std::string readableText(const std::string& bytes);

}  // namespace probewright::reports
