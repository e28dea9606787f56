#pragma once
#include "tests/thread_sanitizer/tbb_by_threads.h"
