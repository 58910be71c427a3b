# One rule for every room of the house: a folder is a target, a namespace and an include prefix.
include_guard()
include(MaillePackage)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(MAILLE_CCACHE ccache)
if(MAILLE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${MAILLE_CCACHE})
endif()

add_library(maille_options INTERFACE)
target_compile_options(maille_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Inside another's project a new compiler's new warnings must not stop the build.
  $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>
  # OpenMesh copies Eigen points before they have values.
  -Wno-maybe-uninitialized
  # Same bytes out on every machine: no fused operations that only some processors have.
  -ffp-contract=off)
target_include_directories(maille_options INTERFACE ${PROJECT_SOURCE_DIR})
if(MAILLE_SANITIZE)
  target_compile_options(maille_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(maille_options INTERFACE -fsanitize=address,undefined)
endif()

# maille_room(volmesh io): the library maille_volmesh, alias maille::volmesh, of the .cc files in the
# current folder and in the sub-folders named. Installed with its headers as the component `volmesh`.
function(maille_room name)
  set(patterns ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  foreach(folder IN LISTS ARGN)
    list(APPEND patterns ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cc)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  add_library(maille_${name} STATIC ${sources})
  add_library(maille::${name} ALIAS maille_${name})
  target_link_libraries(maille_${name} PRIVATE $<BUILD_INTERFACE:maille_options>)
  target_compile_features(maille_${name} PUBLIC cxx_std_20)
  target_include_directories(maille_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${MAILLE_INCLUDE_FOLDER}>)
  set_target_properties(maille_${name} PROPERTIES EXPORT_NAME ${name})
  maille_install_room(${name})
endfunction()
