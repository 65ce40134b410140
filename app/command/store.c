/* What a resumable output needs of the operating system: a lock that goes with its process, and a
 * file that grows from a known length on. */
#define _XOPEN_SOURCE 700
#define _DEFAULT_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Take the lock of a name: its descriptor, -1 if another process has it, -2 if that fails. Who has
 * the lock writes into the file who it is; what another wrote is in `holder`. */
int faststrip_lock(const char *path, char *holder, int capacity)
{
    char host[HOST_NAME_MAX + 1] = "", line[HOST_NAME_MAX + 40];
    struct stat own, there;
    ssize_t n;
    int file, length;

    for (;;) {
        file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file < 0)
            return -2;
        if (flock(file, LOCK_EX | LOCK_NB) != 0) {
            if (errno != EWOULDBLOCK) {
                close(file);
                return -2;
            }
            n = read(file, holder, (size_t)capacity - 1);
            holder[n > 0 ? n : 0] = '\0';
            close(file);
            return -1;
        }
        /* Whoever had it may have removed the name in between. */
        if (fstat(file, &own) == 0 && stat(path, &there) == 0 && own.st_ino == there.st_ino
            && own.st_dev == there.st_dev)
            break;
        close(file);
    }
    gethostname(host, sizeof host - 1);
    length = snprintf(line, sizeof line, "process %ld on %s", (long)getpid(), host);
    /* Only words for others: without them the lock holds all the same. */
    if (ftruncate(file, 0) == 0)
        n = write(file, line, (size_t)length);
    return file;
}

/* Give a lock back, with its name. */
void faststrip_unlock(int file, const char *path)
{
    unlink(path);
    close(file);
}

/* Open a file for writing behind its first bytes; what follows them is dropped. The descriptor, -1
 * if that fails, -2 if the file is shorter. */
int faststrip_open_behind(const char *path, int64_t bytes)
{
    int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666), trouble;
    struct stat about;

    if (file < 0)
        return -1;
    if (fstat(file, &about) == 0 && about.st_size < bytes) {
        close(file);
        return -2;
    }
    if (ftruncate(file, bytes) == 0 && lseek(file, bytes, SEEK_SET) == bytes)
        return file;
    trouble = errno;
    close(file);
    errno = trouble;
    return -1;
}

/* Write all of it; not 0 if that fails. */
int faststrip_write(int file, const char *text, int64_t length)
{
    ssize_t n;

    while (length > 0) {
        n = write(file, text, (size_t)length);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return 1;
        text += n;
        length -= n;
    }
    return 0;
}

/* Close a file, on the disk if that is asked for; not 0 if anything failed. */
int faststrip_close(int file, int synchronise)
{
    int failed = synchronise && fsync(file) != 0 && errno != EINVAL, trouble = errno;

    if (close(file) != 0)
        return 1;
    errno = trouble;
    return failed;
}

/* What was written, to the disk; not 0 if that fails. */
int faststrip_synchronise(int file)
{
    return fdatasync(file) != 0 && errno != EINVAL;
}

/* Length of a file, -1 if there is none. */
int64_t faststrip_length(const char *path)
{
    struct stat about;

    return stat(path, &about) == 0 && S_ISREG(about.st_mode) ? (int64_t)about.st_size : -1;
}

void faststrip_nap(int milliseconds)
{
    struct timespec time = { milliseconds / 1000, 1000000L * (milliseconds % 1000) };

    nanosleep(&time, NULL);
}
