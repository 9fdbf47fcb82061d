/// The boundary: C on one side, exceptions on the other.
#include "halfspace/c_api/halfspace.h"

#include <new>
#include <string>

#include "halfspace/c_api/golden_model.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/quote.hpp"

struct halfspace_model {
  halfspace::c_api::GoldenModel model;
  std::string text;
  const char* error = "";
};

namespace {

using halfspace::InputError;
using halfspace::c_api::GoldenModel;

/// Leaves the message for halfspace_error(). There may be no memory for it.
void keep(halfspace_model& handle, const char* text) noexcept {
  try {
    handle.text = halfspace::printable(text);
    handle.error = handle.text.c_str();
  } catch (...) {
    handle.error = "out of memory";
  }
}

/// Runs call(model), which returns a status; what it throws becomes one.
template <class Call>
int guarded(halfspace_model* handle, Call&& call) noexcept {
  if (handle == nullptr) {
    return HALFSPACE_REFUSED;
  }
  handle->error = "";
  try {
    return static_cast<int>(call(handle->model));
  } catch (const InputError& error) {
    keep(*handle, error.what());
    return HALFSPACE_REFUSED;
  } catch (const std::bad_alloc&) {
    handle->error = "out of memory";
    return HALFSPACE_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    keep(*handle, error.what());
    return HALFSPACE_INTERNAL;
  } catch (...) {
    handle->error = "unknown failure";
    return HALFSPACE_INTERNAL;
  }
}

/// A text argument.
const char* demand_text(const char* text, const char* what) {
  if (text == nullptr) {
    throw InputError(std::string(what) + " is a null pointer; legal: a text");
  }
  return text;
}

}  // namespace

const char* halfspace_version(void) { return HALFSPACE_VERSION; }
int halfspace_abi_version(void) { return HALFSPACE_ABI_VERSION; }

halfspace_model* halfspace_create(void) {
  try {
    return new halfspace_model;
  } catch (...) {
    return nullptr;
  }
}

void halfspace_destroy(halfspace_model* model) { delete model; }

const char* halfspace_error(const halfspace_model* model) {
  return model == nullptr ? "model is a null pointer; legal: what halfspace_create returned" : model->error;
}

int halfspace_configure_file(halfspace_model* model, const char* path) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.configure_file(demand_text(path, "path"));
    return HALFSPACE_OK;
  });
}

int halfspace_configure(halfspace_model* model, const char* toml) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.configure(demand_text(toml, "toml"));
    return HALFSPACE_OK;
  });
}

int halfspace_set(halfspace_model* model, const char* assignment) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.set(demand_text(assignment, "assignment"));
    return HALFSPACE_OK;
  });
}

int halfspace_packet_bits(halfspace_model* model, int link) {
  return guarded(model, [&](GoldenModel& golden) { return golden.packet_bits(link); });
}

const char* halfspace_link_name(int link) { return halfspace::c_api::link_name(link); }

int halfspace_watch(halfspace_model* model, int link) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.watch(link);
    return HALFSPACE_OK;
  });
}

int halfspace_put(halfspace_model* model, int link, const uint32_t* packet, int bits) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.put(link, packet, bits);
    return HALFSPACE_OK;
  });
}

int halfspace_get(halfspace_model* model, int link, uint32_t* packet, int bits) {
  return guarded(model, [&](GoldenModel& golden) {
    if (golden.get(link, packet, bits)) {
      return HALFSPACE_OK;
    }
    model->error = "no packet is expected";
    return HALFSPACE_NONE;
  });
}

int halfspace_check(halfspace_model* model, int link, const uint32_t* packet, int bits) {
  return guarded(model, [&](GoldenModel& golden) {
    const std::optional<std::string> difference = golden.check(link, packet, bits);
    if (!difference) {
      return HALFSPACE_OK;
    }
    keep(*model, difference->c_str());
    return HALFSPACE_DIFFERENT;
  });
}

int64_t halfspace_pending(halfspace_model* model, int link) {
  int64_t count = 0;
  const int status = guarded(model, [&](GoldenModel& golden) {
    count = static_cast<int64_t>(golden.pending(link));
    return HALFSPACE_OK;
  });
  return status == HALFSPACE_OK ? count : status;
}

int halfspace_reset(halfspace_model* model) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.reset();
    return HALFSPACE_OK;
  });
}

int halfspace_define_surface(halfspace_model* model, uint32_t first_tile, int format, int width, int height,
                             uint32_t code) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.surfaces().define(first_tile, format, width, height, code, golden.tile_size());
    return HALFSPACE_OK;
  });
}

int halfspace_clear_surface(halfspace_model* model, uint32_t first_tile, uint32_t code) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.surfaces().clear(first_tile, code);
    return HALFSPACE_OK;
  });
}

int halfspace_read_depth(halfspace_model* model, uint32_t first_tile, int x, int y, uint32_t* code) {
  return guarded(model, [&](GoldenModel& golden) {
    if (code == nullptr) {
      throw InputError("code is a null pointer; legal: where to put a depth code");
    }
    *code = golden.surfaces().read(first_tile, x, y);
    return HALFSPACE_OK;
  });
}

int halfspace_write_depth(halfspace_model* model, uint32_t first_tile, int x, int y, uint32_t code) {
  return guarded(model, [&](GoldenModel& golden) {
    golden.surfaces().write(first_tile, x, y, code);
    return HALFSPACE_OK;
  });
}
