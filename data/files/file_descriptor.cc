#include "data/files/file_descriptor.h"

#include <unistd.h>

namespace errmap::data {

FileDescriptor::~FileDescriptor() {
  if (descriptor_ >= 0) close(descriptor_);
}

int FileDescriptor::Close() { return close(Release()); }

}  // namespace errmap::data
