/// Counters that name and explain themselves: from a list C(name, help) to a struct.
#pragma once

#include <cstdint>

/// Defines struct NAME of 64-bit counters, with fields(visit) calling visit(name, help, member) for each, and
/// +=.
#define HALFSPACE_COUNTER_STRUCT(NAME, LIST)                                    \
  struct NAME {                                                                 \
    LIST(HALFSPACE_COUNTER_MEMBER)                                              \
    template <class Visit>                                                      \
    static void fields(Visit&& visit) {                                         \
      using Self = NAME;                                                        \
      LIST(HALFSPACE_COUNTER_VISIT)                                             \
    }                                                                           \
    NAME& operator+=(const NAME& other) {                                       \
      fields([&](auto, auto, auto member) { this->*member += other.*member; }); \
      return *this;                                                             \
    }                                                                           \
  };
#define HALFSPACE_COUNTER_MEMBER(name, help) std::uint64_t name = 0;
#define HALFSPACE_COUNTER_VISIT(name, help) visit(#name, help, &Self::name);
