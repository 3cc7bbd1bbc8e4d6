// Implements ascii_of_binary_gmsh().
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "lib/core/errors.h"
#include "lib/core/parse_number.h"
#include "lib/mesh/io/gmsh_file.h"

namespace orthodyn {
namespace {

constexpr std::string_view kFormat = "$MeshFormat";

class BinaryGmsh {
 public:
  BinaryGmsh(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  std::string ascii() {
    read_format();
    for (;;) {
      const std::size_t begin = bytes_.find('$', at_);
      if (begin == std::string_view::npos) return std::move(text_);
      at_ = begin;
      const std::string section(line());
      if (section == "$PhysicalNames") copy_section(section);
      else if (section == "$Entities" && version_ == "4.1") read_entities();
      else if (section == "$Nodes") version_ == "4.1" ? read_node_blocks() : read_nodes();
      else if (section == "$Elements") version_ == "4.1" ? read_element_blocks() : read_elements();
      else skip_section(section);
    }
  }

 private:
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
    throw ConfigError(
        path_, fmt::format("byte {} of a binary Gmsh file: ", at_) + fmt::format(message, std::forward<Args>(args)...));
  }

  template <class... Values>
  void add(const Values&... values) {
    ((fmt::format_to(std::back_inserter(text_), "{} ", values)), ...);
  }
  void end_line() { text_ += '\n'; }

  // Takes the rest of the line, without its end.
  std::string_view line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view found = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
  }

  template <class Value>
  Value take() {
    Value value{};
    if (bytes_.size() - at_ < sizeof value) fail("the file ends early; is it truncated?");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  std::int32_t take_int() { return take<std::int32_t>(); }

  // The number of records of `bytes_of_each` bytes. Fails if the rest of the file is too short for them.
  std::uint64_t take_count(std::size_t bytes_of_each) { return checked(take<std::uint64_t>(), bytes_of_each); }
  std::uint64_t checked(std::uint64_t count, std::size_t bytes_of_each) const {
    if (count > (bytes_.size() - at_) / bytes_of_each)
      fail("{} records are announced, more than the rest of the file can hold; is it truncated?", count);
    return count;
  }

  void read_format() {
    at_ = bytes_.find(kFormat);
    line();
    const std::string_view format = line();
    version_ = std::string(format.substr(0, format.find(' ')));
    if (version_ != "2.2" && version_ != "4.1")
      fail("format {}; binary files of 2.2 and 4.1 are read: save it as one of these", TextTokens::quoted(version_));
    if (take_int() != 1) fail("the numbers have another byte order; save the file on this machine, or as ASCII");
    text_ = fmt::format("$MeshFormat\n{} 0 8\n$EndMeshFormat\n", version_);
    skip_section("$MeshFormat");
  }

  void skip_section(const std::string& section) {
    const std::string end = "$End" + (section.empty() ? section : section.substr(1));
    const std::size_t found = bytes_.find(end, at_);
    if (found == std::string_view::npos) fail("no {}; is the file truncated?", end);
    at_ = found + end.size();
  }

  void copy_section(const std::string& section) {
    const std::size_t begin = at_;
    skip_section(section);
    text_ += section + "\n";
    text_ += bytes_.substr(begin, at_ - begin);
    text_ += "\n";
  }

  template <class Read>
  void write_section(const std::string& section, Read&& read) {
    text_ += section + "\n";
    read();
    text_ += "$End" + section.substr(1) + "\n";
    skip_section(section);
  }

  std::uint64_t count_line() {
    const std::string_view found = line();
    std::uint64_t count = 0;
    if (!parse_number(found, count)) fail("expected a number of records, found {}", TextTokens::quoted(found));
    add(count);
    end_line();
    return count;
  }

  void add_doubles(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(take<double>());
  }

  std::size_t nodes_of(std::int32_t type) const { return check_element_type(TextTokens(path_, ""), type).nodes; }

  void read_nodes() {
    write_section("$Nodes", [&] {
      const std::uint64_t count = checked(count_line(), 28);
      for (std::uint64_t i = 0; i < count; ++i) {
        add(take_int());
        add_doubles(3);
        end_line();
      }
    });
  }

  // Blocks of elements with the same type and the same number of tags.
  void read_elements() {
    write_section("$Elements", [&] {
      const std::uint64_t all = count_line();
      for (std::uint64_t done = 0; done < all;) {
        const std::int32_t type = take_int(), count = take_int(), tags = take_int();
        if (count < 1 || tags < 0 || tags > 1000)
          fail("a block of {} elements with {} tags each; is the file damaged?", count, tags);
        const std::size_t nodes = nodes_of(type);
        checked(static_cast<std::uint64_t>(count), 4 * (1 + static_cast<std::size_t>(tags) + nodes));
        for (std::int32_t i = 0; i < count; ++i) {
          add(take_int(), type, tags);
          for (std::size_t k = 0; k < static_cast<std::size_t>(tags) + nodes; ++k) add(take_int());
          end_line();
        }
        done += static_cast<std::uint64_t>(count);
      }
    });
  }

  void read_entities() {
    write_section("$Entities", [&] {
      std::array<std::uint64_t, 4> counts{};
      for (auto& count : counts) add(count = take_count(1));
      end_line();
      for (std::size_t dim = 0; dim < 4; ++dim)
        for (std::uint64_t i = 0; i < counts[dim]; ++i) read_entity(dim);
    });
  }

  void read_entity(std::size_t dim) {
    add(take_int());
    add_doubles(dim == 0 ? 3 : 6);
    for (int list = 0; list < (dim == 0 ? 1 : 2); ++list) {  // physical groups, bounding entities
      const std::uint64_t count = take_count(4);
      add(count);
      for (std::uint64_t i = 0; i < count; ++i) add(take_int());
    }
    end_line();
  }

  std::uint64_t read_totals() {
    const std::uint64_t blocks = take_count(1);
    add(blocks);
    for (int i = 0; i < 3; ++i) add(take<std::uint64_t>());
    end_line();
    return blocks;
  }

  void read_node_blocks() {
    write_section("$Nodes", [&] {
      const std::uint64_t blocks = read_totals();
      for (std::uint64_t b = 0; b < blocks; ++b) {
        const std::int32_t dim = take_int(), entity = take_int(), parametric = take_int();
        const std::size_t numbers = 3 + (parametric != 0 ? static_cast<std::size_t>(std::clamp(dim, 0, 3)) : 0);
        const std::uint64_t count = take_count(8 + 8 * numbers);
        add(dim, entity, parametric, count);
        end_line();
        for (std::uint64_t i = 0; i < count; ++i) {
          add(take<std::uint64_t>());
          end_line();
        }
        for (std::uint64_t i = 0; i < count; ++i) {
          add_doubles(numbers);
          end_line();
        }
      }
    });
  }

  void read_element_blocks() {
    write_section("$Elements", [&] {
      const std::uint64_t blocks = read_totals();
      for (std::uint64_t b = 0; b < blocks; ++b) {
        const std::int32_t dim = take_int(), entity = take_int(), type = take_int();
        const std::size_t nodes = nodes_of(type);
        const std::uint64_t count = take_count(8 * (1 + nodes));
        add(dim, entity, type, count);
        end_line();
        for (std::uint64_t i = 0; i < count; ++i) {
          for (std::size_t k = 0; k < 1 + nodes; ++k) add(take<std::uint64_t>());
          end_line();
        }
      }
    });
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::string version_, text_;
};

}  // namespace

bool is_binary_gmsh(std::string_view text) {
  const std::size_t format = text.find(kFormat);
  if (format == std::string_view::npos) return false;
  const std::size_t begin = text.find('\n', format);
  if (begin == std::string_view::npos) return false;
  std::string_view line = text.substr(begin + 1, std::min<std::size_t>(text.find('\n', begin + 1) - begin, 40));
  line = line.substr(std::min(line.find(' '), line.size()));
  return line.starts_with(" 1 ");
}

std::string ascii_of_binary_gmsh(const std::string& path, std::string_view bytes) {
  return BinaryGmsh(path, bytes).ascii();
}

}  // namespace orthodyn
