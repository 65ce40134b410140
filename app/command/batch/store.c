/* What a resumable output needs of the operating system: a lock that goes with its process, a file
 * that grows from a known length on, and names that are given only where there is nothing yet.
 * Nothing here goes through a symbolic link, or writes into a file that has a second name. */
#define _GNU_SOURCE
#include <ctype.h>
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

static const int by_no_link = O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;

static int close_with(int file, int code)
{
    int trouble = errno;

    close(file);
    errno = trouble;
    return code;
}

/* Make a new file; its descriptor, -1 if that fails. */
int faststrip_create(const char *path)
{
    return open(path, by_no_link | O_CREAT | O_EXCL, 0666);
}

/* Give a file a name that nothing has; not 0 if that fails. */
int faststrip_name_new(const char *old, const char *new)
{
    if (renameat2(AT_FDCWD, old, AT_FDCWD, new, RENAME_NOREPLACE) == 0)
        return 0;
    if (errno == EEXIST)
        return 1;
    /* File systems that cannot do that have links. */
    return link(old, new) != 0 || unlink(old) != 0;
}

/* Is a file in which a lock stands one of ours, and does its name still mean it? 0 if it is another
 * one's, -1 if the name means another file by now. */
static int is_lock(int file, const char *path)
{
    static const char begin[] = "process ";
    char line[sizeof begin + 30] = "", *end;
    struct stat own, there;

    if (fstat(file, &own) != 0 || lstat(path, &there) != 0 || own.st_ino != there.st_ino
        || own.st_dev != there.st_dev)
        return -1;
    if (!S_ISREG(own.st_mode) || own.st_nlink != 1
        || pread(file, line, sizeof line - 1, 0) < (ssize_t)sizeof begin
        || strncmp(line, begin, sizeof begin - 1) != 0)
        return 0;
    for (end = line + sizeof begin - 1; isdigit((unsigned char)*end); end++)
        ;
    return end > line + sizeof begin - 1 && strncmp(end, " on ", 4) == 0;
}

/* Who we are, in the file of a lock; not 0 if that fails. The file is never without such words. */
static int sign(int file)
{
    char host[HOST_NAME_MAX + 1] = "", line[HOST_NAME_MAX + 40];
    int length;

    gethostname(host, sizeof host - 1);
    length = snprintf(line, sizeof line, "process %ld on %s", (long)getpid(), host);
    return pwrite(file, line, (size_t)length, 0) != length || ftruncate(file, length) != 0;
}

/* Take the lock of a name: its descriptor, -1 if another process has it, -2 if that fails, -3 if
 * what has the name is no lock. Who has the lock writes into the file who it is; what another wrote
 * is in `holder`. A new lock is made in a temporary file: it has its name when it is held. */
int faststrip_lock(const char *path, const char *temporary, char *holder, int capacity)
{
    ssize_t n;
    int file, found;

    for (;;) {
        file = open(path, by_no_link);
        if (file < 0 && errno != ENOENT)
            return errno == ELOOP || errno == EISDIR || errno == ENXIO ? -3 : -2;
        if (file < 0) {
            file = faststrip_create(temporary);
            if (file < 0)
                return -2;
            if (flock(file, LOCK_EX | LOCK_NB) == 0 && sign(file) == 0
                && faststrip_name_new(temporary, path) == 0)
                return file;
            found = errno;
            close(file);
            unlink(temporary);
            if (found == EEXIST)
                continue;
            errno = found;
            return -2;
        }
        if (flock(file, LOCK_EX | LOCK_NB) != 0) {
            if (errno != EWOULDBLOCK)
                return close_with(file, -2);
            n = read(file, holder, (size_t)capacity - 1);
            holder[n > 0 ? n : 0] = '\0';
            return close_with(file, -1);
        }
        found = is_lock(file, path);
        if (found == 0)
            return close_with(file, -3);
        if (found > 0)
            return sign(file) == 0 ? file : close_with(file, -2);
        /* Whoever had it has removed the name in between. */
        close(file);
    }
}

/* Give a lock back, with its name. */
void faststrip_unlock(int file, const char *path)
{
    if (is_lock(file, path) > 0)
        unlink(path);
    close(file);
}

/* Open a file for writing behind its first bytes; what follows them is dropped. The descriptor, -1
 * if that fails, -2 if the file is shorter or has another name. */
int faststrip_open_behind(const char *path, int64_t bytes)
{
    int file = open(path, by_no_link);
    struct stat about;

    if (file < 0)
        return -1;
    if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || about.st_nlink != 1
        || about.st_size < bytes)
        return close_with(file, -2);
    if (ftruncate(file, bytes) == 0 && lseek(file, bytes, SEEK_SET) == bytes)
        return file;
    return close_with(file, -1);
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

/* Length of a file, -1 if there is none, or a link. */
int64_t faststrip_length(const char *path)
{
    struct stat about;

    return lstat(path, &about) == 0 && S_ISREG(about.st_mode) ? (int64_t)about.st_size : -1;
}

void faststrip_nap(int milliseconds)
{
    struct timespec time = { milliseconds / 1000, 1000000L * (milliseconds % 1000) };

    nanosleep(&time, NULL);
}
