/* A disk that is slow, or full, for a program that is started with LD_PRELOAD of this: while the folder ODD_DISK has a file named
   "slow", each wait for the disk takes 0.4 s more; while it has one named "full", nothing can be written into a regular file. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WAIT_US = 400000 };

static int is(const char *how) {
    char path[512];
    const char *folder = getenv("ODD_DISK");
    if (!folder) return 0;
    snprintf(path, sizeof path, "%s/%s", folder, how);
    return access(path, F_OK) == 0;
}

int fsync(int file) {
    int (*real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
    if (is("slow")) usleep(WAIT_US);
    return real(file);
}

int fdatasync(int file) {
    int (*real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fdatasync");
    if (is("slow")) usleep(WAIT_US);
    return real(file);
}

ssize_t write(int file, const void *bytes, size_t size) {
    ssize_t (*real)(int, const void *, size_t) = (ssize_t (*)(int, const void *, size_t))dlsym(RTLD_NEXT, "write");
    struct stat opened;
    if (is("full") && fstat(file, &opened) == 0 && S_ISREG(opened.st_mode)) {
        errno = ENOSPC;
        return -1;
    }
    return real(file, bytes, size);
}
