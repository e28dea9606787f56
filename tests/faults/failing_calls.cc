// Lets the n-th call of one kind in a program fail: loaded with LD_PRELOAD.
//
//   ERRMAP_FAIL=KIND:N     the call that fails, from 1; 0: none
//   ERRMAP_FAIL_LOG=FILE   at the end, the number of calls of the kind; at the
//                          failure, the frames that led to it
//
// Kinds: write, fsync (and fdatasync), rename, open (for writing), ftruncate,
// malloc (calloc and realloc too), site: of each place in the program's own
// code, the first allocation that it leads to. A place is the offset (in
// hexadecimal, as the log of site:0 lists them) of the innermost frame that is
// the program's. Calls on descriptors 1 and 2 do not count:
// what cannot be printed has tests of its own.

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <sys/types.h>

namespace {

std::atomic<long> calls{0};
long failing = 0;
const char* kind = "";
const char* log_path = nullptr;
std::atomic<bool> is_ready{false};
bool by_site = false;
std::uintptr_t program_begin = 0;  // the program's own code
std::uintptr_t program_end = 0;
thread_local bool is_inside = false;

template <typename Function>
Function Real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

int OpenLog() {
  static const auto real_open = Real<int (*)(const char*, int, ...)>("open");
  constexpr mode_t kMode = 0600;
  return real_open(log_path, O_WRONLY | O_CREAT | O_APPEND, kMode);
}

// True where this call of `which` is the one that is to fail.
bool Fails(const char* which) {
  if (!is_ready.load() || is_inside || std::strcmp(which, kind) != 0) {
    return false;
  }
  if (++calls != failing) return false;
  is_inside = true;
  if (log_path != nullptr) {
    constexpr int kMostFrames = 24;
    void* frames[kMostFrames];
    const int log = OpenLog();
    backtrace_symbols_fd(frames, backtrace(frames, kMostFrames), log);
    close(log);
  }
  is_inside = false;
  return true;
}

// Offsets of places seen, in a table that never moves: 0 is a free slot.
constexpr std::size_t kMostSites = 1U << 16U;
std::atomic<std::uintptr_t> sites[kMostSites];

// True the first time.
bool IsNewSite(std::uintptr_t site) {
  for (std::size_t i = site * 2654435761U % kMostSites;;
       i = (i + 1) % kMostSites) {
    std::uintptr_t expected = 0;
    if (sites[i].compare_exchange_strong(expected, site)) return true;
    if (expected == site) return false;
  }
}

// Offset of the innermost of these frames in the program's own code, or 0.
std::uintptr_t SiteOfCall() {
  constexpr int kMostFrames = 12;
  void* frames[kMostFrames];
  const int count = backtrace(frames, kMostFrames);
  for (int i = 0; i < count; ++i) {
    const auto address = reinterpret_cast<std::uintptr_t>(frames[i]);
    if (address >= program_begin && address < program_end) {
      return address - program_begin;
    }
  }
  return 0;
}

bool FailsHere() {
  if (!is_ready.load() || is_inside) return false;
  if (!by_site) return Fails("malloc");
  is_inside = true;
  const std::uintptr_t site = SiteOfCall();
  const bool is_new = site != 0 && IsNewSite(site);
  is_inside = false;
  return is_new && site == static_cast<std::uintptr_t>(failing);
}

// The program is the first of the objects loaded.
int FindProgram(dl_phdr_info* info, std::size_t /*size*/, void* /*data*/) {
  program_begin = info->dlpi_addr;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type == PT_LOAD) {
      program_end = program_begin + part.p_vaddr + part.p_memsz;
    }
  }
  return 1;
}

[[gnu::constructor]] void Begin() {
  void* frames[1];
  backtrace(frames, 1);  // loads what it needs before anything can fail
  log_path = std::getenv("ERRMAP_FAIL_LOG");
  const char* const fail = std::getenv("ERRMAP_FAIL");
  const char* const colon = fail != nullptr ? std::strchr(fail, ':') : nullptr;
  if (colon == nullptr) return;
  static char name[16];
  std::snprintf(
      name, sizeof name, "%.*s", static_cast<int>(colon - fail), fail);
  kind = name;
  by_site = std::strcmp(name, "site") == 0;
  constexpr int kDecimal = 10;
  constexpr int kHexadecimal = 16;
  failing = std::strtol(colon + 1, nullptr, by_site ? kHexadecimal : kDecimal);
  dl_iterate_phdr(FindProgram, nullptr);
  unsetenv("LD_PRELOAD");
}

using MainFunction = int (*)(int, char**, char**);
MainFunction program_main = nullptr;

// What is made before main has nobody to tell: nothing fails until then.
int BeginMain(int argc, char** argv, char** environment) {
  is_ready = *kind != '\0';
  return program_main(argc, argv, environment);
}

[[gnu::destructor]] void End() {
  if (!is_ready.load() || log_path == nullptr) return;
  is_inside = true;
  char text[64];
  const int log = OpenLog();
  if (by_site && failing == 0) {
    for (const auto& site : sites) {
      if (site.load() == 0) continue;
      const int size = std::snprintf(text, sizeof text, "%lx\n", site.load());
      static_cast<void>(!write(log, text, static_cast<std::size_t>(size)));
    }
  }
  const int length =
      std::snprintf(text, sizeof text, "calls %ld\n", calls.load());
  static_cast<void>(!write(log, text, static_cast<std::size_t>(length)));
  close(log);
}

bool IsForWriting(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

}  // namespace

extern "C" {

int __libc_start_main(MainFunction main,
                      int argc,
                      char** argv,
                      void (*init)(),
                      void (*fini)(),
                      void (*linker_fini)(),
                      void* stack_end) {
  static const auto real =
      Real<decltype(&__libc_start_main)>("__libc_start_main");
  program_main = main;
  return real(BeginMain, argc, argv, init, fini, linker_fini, stack_end);
}

ssize_t write(int descriptor, const void* data, std::size_t size) {
  static const auto real =
      Real<ssize_t (*)(int, const void*, std::size_t)>("write");
  if (descriptor > STDERR_FILENO && Fails("write")) {
    errno = ENOSPC;
    return -1;
  }
  return real(descriptor, data, size);
}

int fsync(int descriptor) {
  static const auto real = Real<int (*)(int)>("fsync");
  if (Fails("fsync")) {
    errno = EIO;
    return -1;
  }
  return real(descriptor);
}

int fdatasync(int descriptor) {
  static const auto real = Real<int (*)(int)>("fdatasync");
  if (Fails("fsync")) {
    errno = EIO;
    return -1;
  }
  return real(descriptor);
}

int ftruncate(int descriptor, off_t length) noexcept {
  static const auto real = Real<int (*)(int, off_t)>("ftruncate");
  if (Fails("ftruncate")) {
    errno = EIO;
    return -1;
  }
  return real(descriptor, length);
}

int rename(const char* from, const char* to) noexcept {
  static const auto real = Real<int (*)(const char*, const char*)>("rename");
  if (Fails("rename")) {
    errno = EACCES;
    return -1;
  }
  return real(from, to);
}

int open(const char* path, int flags, ...) {
  static const auto real = Real<int (*)(const char*, int, ...)>("open");
  std::va_list rest;
  va_start(rest, flags);
  const auto mode = static_cast<mode_t>(va_arg(rest, int));
  va_end(rest);
  if (IsForWriting(flags) && Fails("open")) {
    errno = EMFILE;
    return -1;
  }
  return real(path, flags, mode);
}

// mkstemp of the C library calls its own open.
int mkstemp(char* name) {
  static const auto real = Real<int (*)(char*)>("mkstemp");
  if (Fails("open")) {
    errno = EMFILE;
    return -1;
  }
  return real(name);
}

int mkostemp(char* name, int flags) {
  static const auto real = Real<int (*)(char*, int)>("mkostemp");
  if (Fails("open")) {
    errno = EMFILE;
    return -1;
  }
  return real(name, flags);
}

// The C library's own names: dlsym itself allocates.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);

void* malloc(std::size_t size) {
  if (FailsHere()) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  if (FailsHere()) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  if (FailsHere()) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_realloc(block, size);
}

}  // extern "C"
