# SPDX-License-Identifier: BSD-3-Clause
# Compiler settings shared by every target: warnings, sanitizers, ccache with precompiled headers.

add_library(terrane_options INTERFACE)
target_compile_options(terrane_options INTERFACE -Wall -Wextra -Wpedantic
    # A structure with defaults is meant to be filled in by name, in part.
    -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
    # When it optimises, GCC 12 sees overflows inside std::string that are not there (its bugs 105329
    # and 105651), and members of an empty std::optional as used.
    target_compile_options(terrane_options INTERFACE
        -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized)
endif()
if(TERRANE_WERROR)
    target_compile_options(terrane_options INTERFACE -Werror)
endif()

# Programs link this: in a sanitizer build it holds the options and suppressions.
add_library(terrane_sanitizer_options INTERFACE)
if(TERRANE_SANITIZE)
    add_compile_options(-fsanitize=${TERRANE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${TERRANE_SANITIZE})
    target_link_options(terrane_sanitizer_options INTERFACE -rdynamic) # it replaces a function of libraries
    target_sources(terrane_sanitizer_options INTERFACE ${PROJECT_SOURCE_DIR}/tests/sanitizers/options.cpp)
endif()

# Coverage for libFuzzer, in all that a fuzz target may reach.
if(TERRANE_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # A precompiled header holds times and macros that ccache would otherwise count as changes.
    set(launcher ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
                 CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE_PROGRAM})
    set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
    if(TERRANE_PCH)
        # ccache can only reuse what includes a precompiled header when the compiler says which it was.
        add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
    endif()
endif()
find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
    add_link_options(-fuse-ld=mold)
endif()
