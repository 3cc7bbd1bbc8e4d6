#include "lib/mesh/io/vtk_numbers.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <system_error>

#include "lib/core/parse_number.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

template <class T>
std::vector<double> numbers(std::string_view bytes) {
  std::vector<double> out(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < out.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    out[i] = static_cast<double>(value);
  }
  return out;
}

}  // namespace

std::optional<VtkType> vtk_type(std::string_view name) {
  static const std::map<std::string_view, VtkType> types{
      {"Int8", {'i', 1}},    {"UInt8", {'u', 1}},          {"Int16", {'i', 2}},         {"UInt16", {'u', 2}},
      {"Int32", {'i', 4}},   {"UInt32", {'u', 4}},         {"Int64", {'i', 8}},         {"UInt64", {'u', 8}},
      {"Float32", {'f', 4}}, {"Float64", {'f', 8}},        {"String", {'i', 1}},        {"char", {'i', 1}},
      {"unsigned_char", {'u', 1}}, {"short", {'i', 2}},    {"unsigned_short", {'u', 2}}, {"int", {'i', 4}},
      {"unsigned_int", {'u', 4}},  {"long", {'i', 8}},     {"unsigned_long", {'u', 8}}, {"float", {'f', 4}},
      {"double", {'f', 8}},  {"vtktypeint64", {'i', 8}},   {"vtktypeint32", {'i', 4}},  {"vtkIdType", {'i', 4}},
      {"vtktypeuint8", {'u', 1}}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

std::vector<double> vtk_numbers(std::string_view bytes, VtkType type) {
  if (type.kind == 'f') return type.width == 4 ? numbers<float>(bytes) : numbers<double>(bytes);
  const bool is_signed = type.kind == 'i';
  switch (type.width) {
    case 1: return is_signed ? numbers<std::int8_t>(bytes) : numbers<std::uint8_t>(bytes);
    case 2: return is_signed ? numbers<std::int16_t>(bytes) : numbers<std::uint16_t>(bytes);
    case 4: return is_signed ? numbers<std::int32_t>(bytes) : numbers<std::uint32_t>(bytes);
    default: return is_signed ? numbers<std::int64_t>(bytes) : numbers<std::uint64_t>(bytes);
  }
}

std::vector<double> vtk_numbers(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<double> out;
  for (std::size_t p = text.find_first_not_of(kBlanks); p != std::string_view::npos;
       p = text.find_first_not_of(kBlanks, p)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, p), text.size());
    const std::string_view word = text.substr(p, end - p);
    double value = 0;
    if (!parse_number(word, value)) throw std::runtime_error("expected a number, found " + TextTokens::quoted(word));
    out.push_back(value);
    p = end;
  }
  return out;
}

}  // namespace orthodyn
