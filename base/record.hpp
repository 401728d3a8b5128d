// Structs as bytes and back, by one list of their members for both directions:
//   template <>
//   inline constexpr auto record_members<Level> = std::tuple(&Level::error, &Level::ids);
#pragma once

#include "base/bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace triptych {

/// The members of a struct in the order of its bytes. A struct without such a list is written as it lies in
/// memory.
template <typename Value>
inline constexpr auto record_members = nullptr;

template <typename Value>
concept Record = !std::is_same_v<std::remove_const_t<decltype(record_members<Value>)>, std::nullptr_t>;

template <typename Value>
inline constexpr bool is_vector = false;
template <typename Item>
inline constexpr bool is_vector<std::vector<Item>> = true;

/// Members one after the other; vectors behind their 64-bit length; texts, and vectors of texts, behind a
/// 32-bit one. The writer is a ByteWriter, or anything else with a write_all() like its own.
template <typename Writer, typename Value>
void write_record(Writer& writer, const Value& value) {
  const auto write_plain = [&](const auto& plain) { writer.write_all(std::span(&plain, 1)); };
  if constexpr (Record<Value>) {
    std::apply([&](auto... member) { (write_record(writer, value.*member), ...); }, record_members<Value>);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    write_plain(static_cast<uint32_t>(value.size()));
    writer.write_all(std::span<const char>(value));
  } else if constexpr (is_vector<Value>) {
    using Item = typename Value::value_type;
    if constexpr (std::is_same_v<Item, std::string>) {
      write_plain(static_cast<uint32_t>(value.size()));
    } else {
      write_plain(uint64_t{value.size()});
    }
    if constexpr (std::is_trivially_copyable_v<Item> && !Record<Item>) {
      writer.write_all(std::span<const Item>(value));
    } else {
      for (const Item& item : value) write_record(writer, item);
    }
  } else {
    write_plain(value);
  }
}

/// What write_record() wrote. Error (place, byte) where the bytes end before; lengths are checked before
/// anything is allocated for plain values.
template <typename Value>
Value read_record(ByteReader& reader) {
  if constexpr (Record<Value>) {
    Value value;
    const auto read = [&](auto& member) {
      member = read_record<std::remove_reference_t<decltype(member)>>(reader);
    };
    std::apply([&](auto... member) { (read(value.*member), ...); }, record_members<Value>);
    return value;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return reader.read_text();
  } else if constexpr (is_vector<Value>) {
    using Item = typename Value::value_type;
    if constexpr (std::is_trivially_copyable_v<Item> && !Record<Item>) {
      return reader.read_all<Item>(reader.read<uint64_t>());
    } else {
      using Count = std::conditional_t<std::is_same_v<Item, std::string>, uint32_t, uint64_t>;
      Value values;
      for (auto count = reader.read<Count>(); count > 0; --count) values.push_back(read_record<Item>(reader));
      return values;
    }
  } else {
    return reader.read<Value>();
  }
}

template <typename Value>
std::vector<std::byte> record_bytes(const Value& value) {
  ByteWriter writer;
  write_record(writer, value);
  return std::move(writer.bytes());
}

/// The record that the bytes hold. Error (place) if they are more or fewer than that.
template <typename Value>
Value record_of(std::span<const std::byte> bytes, const std::string& place) {
  ByteReader reader(bytes, place);
  Value value = read_record<Value>(reader);
  reader.expect_end();
  return value;
}

}  // namespace triptych
