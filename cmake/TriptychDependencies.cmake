# Everything that Triptych takes from Debian 12 (packages: launch/packages.txt).
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TBB REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(PNG REQUIRED)
find_package(embree 3 REQUIRED)
find_package(glfw3 REQUIRED)
find_package(X11 REQUIRED COMPONENTS Xext)
find_package(OpenSSL 3 REQUIRED)
find_package(tomlplusplus REQUIRED)
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(OSMESA REQUIRED osmesa)  # its header: context_osmesa.cpp loads the library itself
pkg_check_modules(TINYGLTF REQUIRED IMPORTED_TARGET tinygltf)
pkg_check_modules(MINIZIP REQUIRED IMPORTED_TARGET minizip)
pkg_check_modules(JPEG REQUIRED IMPORTED_TARGET libjpeg)
find_path(ASIO_INCLUDE_DIR asio.hpp REQUIRED)

# OpenGL's functions: glad 2 generates the loader offline at build time. Debian's python has it; another
# python may come first on the PATH.
set(GLAD_DIR ${CMAKE_BINARY_DIR}/glad)
set(GLAD_COMMAND /usr/bin/python3 -m glad --api gl:core=4.5 --extensions GL_ARB_shader_draw_parameters
    --reproducible --quiet --out-path ${GLAD_DIR} c)
add_custom_command(OUTPUT ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h COMMAND ${GLAD_COMMAND} VERBATIM)
add_library(glad STATIC ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h)
target_include_directories(glad SYSTEM PUBLIC $<BUILD_INTERFACE:${GLAD_DIR}/include>)
set_target_properties(glad PROPERTIES POSITION_INDEPENDENT_CODE ON)
