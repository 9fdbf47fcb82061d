/// tinygltf, as mesh_gltf.cpp uses it: no images, no file access but through callbacks, nlohmann_json from
/// the system.
#pragma once

#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <fstream>
#include <nlohmann/json.hpp>

#include <tiny_gltf.h>
