// Constant tables that must not fill a microcontroller's RAM. On an AVR, flash is an address space
// of its own and is read by special instructions; everywhere else this is a plain array. The only
// file that knows <avr/pgmspace.h>.
//
//     VAGUS_FLASH_TABLE(int16_t, kSine, 129) = { 0, 403, … };
//     int16_t s = flash_read(&kSine[i]);
//
//     VAGUS_FLASH_TEXT(kFull, "memory is full");
//     char c = flash_read(kFull + i);                 // '\0' at its end
#pragma once

#include <stdint.h>

#if defined(__AVR__)
#include <avr/pgmspace.h>
#define VAGUS_FLASH_TABLE(type, name, size) const type name[size] PROGMEM
#define VAGUS_FLASH_TEXT(name, text) const char name[] PROGMEM = text
#else
#define VAGUS_FLASH_TABLE(type, name, size) const type name[size]
#define VAGUS_FLASH_TEXT(name, text) const char name[] = text
#endif

namespace vagus {

#if defined(__AVR__)
inline char flash_read(const char* at) {
    return static_cast<char>(pgm_read_byte(at));
}
inline uint8_t flash_read(const uint8_t* at) {
    return pgm_read_byte(at);
}
inline int16_t flash_read(const int16_t* at) {
    return static_cast<int16_t>(pgm_read_word(at));
}
inline uint16_t flash_read(const uint16_t* at) {
    return pgm_read_word(at);
}
// Pointers, and the structs of tables.
template <typename T>
inline T flash_read(const T* at) {
    T value;
    memcpy_P(&value, at, sizeof value);
    return value;
}
#else
template <typename T>
inline T flash_read(const T* at) {
    return *at;
}
#endif

}  // namespace vagus
