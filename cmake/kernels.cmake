# tyndall_kernels(NAME n SOURCE k.cc [HEADER k.h..] [LINK targets..])
#
# One program for any x86-64: the source is compiled once per instruction set and the result chosen at run time.
# The source wraps all it defines in namespace TYNDALL_KERNEL_NAMESPACE (baseline, avx2 or avx512) and exports exactly
# one function, extern "C", named <n>_<instruction set>:
#
#   namespace TYNDALL_KERNEL_NAMESPACE { ... }
#   extern "C" void TYNDALL_KERNEL_ENTRY(...) { ... }        TYNDALL_KERNEL_ENTRY is that name, ready to use
#
# The trap this closes: an inline function of a shared header that is not inlined comes out of the AVX-512 object as a
# weak symbol, and the linker may keep that copy for the whole program, which then dies on an older machine. So each
# object is linked by itself (`ld -r --force-group-allocation` dissolves its COMDAT groups) and every symbol but the
# entry is made local. scripts/check_kernels.sh looks at the result, and tests run the linked program on an emulated
# machine without AVX. tests/kernel_isolation/ is the smallest example.
#
# Static initialisers are refused by the same check: they would run on every machine, whatever is chosen later.
include_guard(GLOBAL)

# Widest first, the order in which the trap bites: should isolation ever fail, the tests see it.
set(TYNDALL_KERNEL_SETS avx512 avx2 baseline)
set(TYNDALL_KERNEL_MARCH_baseline -march=x86-64)
set(TYNDALL_KERNEL_MARCH_avx2 -march=x86-64-v3)
set(TYNDALL_KERNEL_MARCH_avx512 -march=x86-64-v4 -mprefer-vector-width=512)

function(tyndall_kernels)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;SOURCE" "HEADER;LINK")
  tyndall_missing(${arg_NAME} lacks xsimd ${arg_LINK})
  if(lacks)
    return()
  endif()
  # GNU's own: lld and gold lack --force-group-allocation.
  find_program(TYNDALL_LD NAMES ld.bfd x86_64-linux-gnu-ld REQUIRED)
  find_program(TYNDALL_OBJCOPY NAMES x86_64-linux-gnu-objcopy objcopy REQUIRED)
  find_program(TYNDALL_NM NAMES x86_64-linux-gnu-nm nm REQUIRED)

  set(closed "")
  foreach(set IN LISTS TYNDALL_KERNEL_SETS)
    set(entry "${arg_NAME}_${set}")
    set(objects "${entry}_open")
    add_library(${objects} OBJECT ${arg_SOURCE} ${arg_HEADER})
    target_link_libraries(${objects} PRIVATE tyndall_headers tyndall_flags xsimd ${arg_LINK})
    target_compile_definitions(${objects} PRIVATE
      TYNDALL_KERNEL_NAMESPACE=${set} TYNDALL_KERNEL_ENTRY=${entry})
    # A kernel only computes: no exceptions, no type information. -fno-gnu-unique and -fno-addrsig keep out two kinds
    # of symbol table entries that objcopy cannot make local.
    target_compile_options(${objects} PRIVATE
      ${TYNDALL_KERNEL_MARCH_${set}} $<$<CONFIG:Release>:-O3> -fno-exceptions -fno-rtti -fvisibility=hidden
      $<IF:$<CXX_COMPILER_ID:Clang>,-fno-addrsig,-fno-gnu-unique>)
    if(NOT set STREQUAL "baseline")
      set_target_properties(${objects} PROPERTIES CXX_CLANG_TIDY "")  # the same text: once is enough
    endif()
    set(object "${CMAKE_CURRENT_BINARY_DIR}/${entry}.o")
    add_custom_command(OUTPUT "${object}"
      COMMAND ${TYNDALL_LD} -r --force-group-allocation -o "${object}.open" $<TARGET_OBJECTS:${objects}>
      COMMAND ${TYNDALL_OBJCOPY} --keep-global-symbol=${entry} "${object}.open" "${object}"
      DEPENDS $<TARGET_OBJECTS:${objects}>
      COMMENT "Closing kernel ${entry}" VERBATIM COMMAND_EXPAND_LISTS)
    set_source_files_properties("${object}" PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
    list(APPEND closed "${object}")
    # Instrumented objects bring constructors of their own, which is why sanitizer and coverage builds go unchecked.
    if(TYNDALL_BUILD_TESTS AND NOT TYNDALL_INSTRUMENTED)
      add_test(NAME kernel_symbols.${entry}
        COMMAND "${PROJECT_SOURCE_DIR}/scripts/check_kernels.sh" "${object}" "${entry}")
      set_tests_properties(kernel_symbols.${entry} PROPERTIES ENVIRONMENT "NM=${TYNDALL_NM}" LABELS house)
    endif()
  endforeach()

  add_library(${arg_NAME} STATIC ${closed})
  add_library(tyndall::${arg_NAME} ALIAS ${arg_NAME})
  set_target_properties(${arg_NAME} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${arg_NAME} PUBLIC tyndall_headers PRIVATE tyndall_flags ${arg_LINK})
endfunction()
