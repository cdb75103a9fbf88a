// Numbers as the bytes that processes of one computer and binary topics exchange: little endian.
#pragma once

#include <string>
#include <type_traits>

namespace vagus::serve {

// As it is in the memory of this computer.
template <typename T>
requires std::is_trivially_copyable_v<T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace vagus::serve
