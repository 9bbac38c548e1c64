"""The names that headers of C and POSIX declare outside of namespaces: no namespace may have one of them."""

from functools import cache

_VARIANTS = ("f", "l", "f32", "f32x", "f64", "f64x", "f128", "64", "_r", "_l", "_unlocked", "_np")
"""Endings of names that are declared with and without them."""


def is_c_name(name: str) -> bool:
    """Whether a header may declare the name; names that end with `_t` are reserved for types."""
    names = _names()
    bases = (name.removesuffix(ending) for ending in _VARIANTS if name.endswith(ending))
    return name.endswith("_t") or name in names or any(base in names for base in bases)


@cache
def _names() -> frozenset[str]:
    return frozenset(_NAMES.split())


_NAMES = """
a64l abort abs accept accept4 access acct acos acosh addrinfo adjtime aio_cancel aio_error aio_fsync aio_init aio_read
aio_return aio_suspend aio_write aiocb aioinit alarm aligned_alloc alloca alphasort arc4random arc4random_buf
arc4random_uniform asctime asin asinh asprintf at_quick_exit atan atan2 atanh atexit atof atoi atol backtrace
backtrace_symbols backtrace_symbols_fd basename bcmp bcopy bind bind_textdomain_codeset bindresvport bindresvport6
bindtextdomain brk bsearch btowc bzero c16rtomb c32rtomb c8rtomb calloc canonicalize canonicalize_file_name catclose
catgets catopen cbrt ceil cfgetispeed cfgetospeed cfmakeraw cfsetispeed cfsetospeed cfsetspeed chdir chmod chown chroot
clearenv clearerr clock clock_adjtime clock_getcpuclockid clock_getres clock_gettime clock_nanosleep clock_settime
clone close close_range closedir closefrom closelog cmsghdr confstr connect copy_file_range copysign cos cosh creat
crypt crypt_checksalt crypt_data crypt_gensalt crypt_gensalt_ra crypt_gensalt_rn crypt_preferred_method crypt_ra
crypt_rn ctermid ctime cuserid d_fileno daddl daemon daylight dcgettext dcngettext ddivl dfmal dgettext difftime dirent
dirfd dirname div dl_find_object dladdr dladdr1 dlclose dlerror dlinfo dlmopen dlopen dlsym dlvsym dmull dngettext
dprintf drand48 drand48_data drem dsqrtl dsubl dup dup2 dup3 duplocale dysize eaccess ecvt endgrent endhostent
endnetent endnetgrent endorder endprotoent endpwent endrpcent endservent endusershell entry environ epoll_create
epoll_create1 epoll_ctl epoll_data epoll_event epoll_pwait epoll_pwait2 epoll_wait erand48 erf erfc errno euidaccess
eventfd eventfd_read eventfd_write execl execle execlp execv execve execveat execvp execvpe exit exp exp10 exp2
explicit_bzero expm1 f32addf128 f32addf32x f32addf64 f32addf64x f32divf128 f32divf32x f32divf64 f32divf64x f32fmaf128
f32fmaf32x f32fmaf64 f32fmaf64x f32mulf128 f32mulf32x f32mulf64 f32mulf64x f32sqrtf128 f32sqrtf32x f32sqrtf64
f32sqrtf64x f32subf128 f32subf32x f32subf64 f32subf64x f32xaddf128 f32xaddf64 f32xaddf64x f32xdivf128 f32xdivf64
f32xdivf64x f32xfmaf128 f32xfmaf64 f32xfmaf64x f32xmulf128 f32xmulf64 f32xmulf64x f32xsqrtf128 f32xsqrtf64 f32xsqrtf64x
f32xsubf128 f32xsubf64 f32xsubf64x f64addf128 f64addf64x f64divf128 f64divf64x f64fmaf128 f64fmaf64x f64mulf128
f64mulf64x f64sqrtf128 f64sqrtf64x f64subf128 f64subf64x f64xaddf128 f64xdivf128 f64xfmaf128 f64xmulf128 f64xsqrtf128
f64xsubf128 f_owner_ex fabs faccessat fadd fallocate fchdir fchmod fchmodat fchown fchownat fclose fcloseall fcntl fcvt
fd_mask fd_set fdatasync fdim fdiv fdopen fdopendir feclearexcept fedisableexcept feenableexcept fegetenv fegetexcept
fegetexceptflag fegetmode fegetround feholdexcept feof feraiseexcept ferror fesetenv fesetexcept fesetexceptflag
fesetmode fesetround fetestexcept fetestexceptflag feupdateenv fexecve fflush ffma ffs ffsll fgetc fgetgrent fgetpos
fgetpwent fgets fgetwc fgetws file_handle fileno finite flock flockfile floor fma fmax fmaximum fmaximum_mag
fmaximum_mag_num fmaximum_num fmaxmag fmemopen fmin fminimum fminimum_mag fminimum_mag_num fminimum_num fminmag fmod
fmul fnmatch fopen fopencookie fork fpathconf fpclassify fprintf fputc fputs fputwc fputws fread free freeaddrinfo
freeifaddrs freelocale freopen frexp fromfp fromfpx fscanf fseek fseeko fsetpos fsqrt fstat fstatat fstatvfs fsub fsync
ftell ftello ftok ftruncate ftrylockfile ftw funlockfile futimens futimes futimesat fwide fwprintf fwrite fwscanf
gai_cancel gai_error gai_strerror gai_suspend gaicb gamma gcvt get_current_dir_name getaddrinfo getaddrinfo_a getc
getchar getcontext getcpu getcwd getdate getdate_err getdelim getdents64 getdirentries getdomainname getdtablesize
getegid getentropy getenv geteuid getgid getgrent getgrgid getgrnam getgrouplist getgroups gethostbyaddr gethostbyname
gethostbyname2 gethostent gethostid gethostname getifaddrs getipv4sourcefilter getitimer getline getloadavg getlogin
getnameinfo getnetbyaddr getnetbyname getnetent getnetgrent getopt getopt_long getopt_long_only getpagesize getpass
getpayload getpeername getpgid getpgrp getpid getppid getpriority getprotobyname getprotobynumber getprotoent getpt
getpw getpwent getpwnam getpwuid getresgid getresuid getrlimit getrpcbyname getrpcbynumber getrpcent getrusage
getservbyname getservbyport getservent getsid getsockname getsockopt getsourcefilter getsubopt gettext gettid
gettimeofday getuid getumask getusershell getw getwc getwchar getwd glob glob_pattern_p globfree gmtime grantpt group
group_filter group_member group_req group_source_req gsignal h_addr h_errno hcreate hdestroy herror hostent hsearch
hsearch_data hstrerror htonl htons hypot iconv iconv_close iconv_open if_freenameindex if_indextoname if_nameindex
if_nametoindex ifa_broadaddr ifa_dstaddr iface ifaddr ifaddrs ifc_buf ifc_req ifconf ifmap ifr_addr ifr_bandwidth
ifr_broadaddr ifr_data ifr_dstaddr ifr_flags ifr_hwaddr ifr_ifindex ifr_map ifr_metric ifr_mtu ifr_name ifr_netmask
ifr_newname ifr_qlen ifr_slave ifreq ilogb imaxabs imaxdiv in6_addr in6_pktinfo in6addr_any in6addr_loopback in_addr
in_pktinfo index inet6_opt_append inet6_opt_find inet6_opt_finish inet6_opt_get_val inet6_opt_init inet6_opt_next
inet6_opt_set_val inet6_option_alloc inet6_option_append inet6_option_find inet6_option_init inet6_option_next
inet6_option_space inet6_rth_add inet6_rth_getaddr inet6_rth_init inet6_rth_reverse inet6_rth_segments inet6_rth_space
inet_addr inet_aton inet_lnaof inet_makeaddr inet_net_ntop inet_net_pton inet_neta inet_netof inet_network
inet_nsap_addr inet_nsap_ntoa inet_ntoa inet_ntop inet_pton initgroups initstate innetgr inotify_add_watch
inotify_event inotify_init inotify_init1 inotify_rm_watch insque ioctl iovec ip6_mtuinfo ip_mreq ip_mreq_source
ip_mreqn ip_msfilter ip_opts ipc_perm ipv6_mreq iruserok iruserok_af isalnum isalpha isascii isatty isblank iscanonical
iscntrl isctype isdigit iseqsig isfdtype isfinite isgraph isgreater isgreaterequal isinf isless islessequal
islessgreater islower isnan isnormal isprint ispunct issignaling isspace isunordered isupper iswalnum iswalpha iswblank
iswcntrl iswctype iswdigit iswgraph iswlower iswprint iswpunct iswspace iswupper iswxdigit isxdigit iszero itimerspec
itimerval j0 j1 jmp_buf jn jrand48 kill killpg l64a labs lchmod lchown lcong48 lconv ldexp ldiv leaf lfind lgamma
lgammaf128_r lgammaf32_r lgammaf32x_r lgammaf64_r lgammaf64x_r lgammaf_r lgammal_r linger link link_map linkat linux
lio_listio listen llabs lldiv llogb llrint llround localeconv localtime lockf log log10 log1p log2 logb longjmp lrand48
lrint lround lsearch lseek lstat lutimes madvise makecontext mallinfo mallinfo2 malloc malloc_info malloc_stats
malloc_trim malloc_usable_size mallopt math_errhandling mblen mbrlen mbrtoc16 mbrtoc32 mbrtoc8 mbrtowc mbsinit
mbsnrtowcs mbsrtowcs mbstowcs mbtowc memalign memccpy memchr memcmp memcpy memfd_create memfrob memmem memmove mempcpy
memrchr memset mincore mkdir mkdirat mkdtemp mkfifo mkfifoat mknod mknodat mkostemp mkostemps mkstemp mkstemps mktemp
mktime mlock mlock2 mlockall mmap mmsghdr modf mprotect mq_attr mq_close mq_getattr mq_notify mq_open mq_receive
mq_send mq_setattr mq_timedreceive mq_timedsend mq_unlink mrand48 mremap msg_cbytes msgbuf msgctl msgget msghdr msginfo
msgrcv msgsnd msqid_ds msync munlock munlockall munmap name_to_handle_at nan nanosleep nearbyint netent newlocale
nextafter nextdown nexttoward nextup nftw ngettext nice nl_catd nl_item nl_langinfo no_argument nrand48 ntohl ntohs
obstack obstack_printf obstack_vprintf on_exit open open_by_handle_at open_memstream open_wmemstream openat opendir
openlog optarg opterr optind option optional_argument optopt osockaddr passwd pathconf pause pclose perror pipe pipe2
pkey_alloc pkey_free pkey_get pkey_mprotect pkey_set poll pollfd popen posix_fadvise posix_fallocate posix_madvise
posix_memalign posix_openpt posix_spawn posix_spawn_file_actions_addchdir_np posix_spawn_file_actions_addclose
posix_spawn_file_actions_addclosefrom_np posix_spawn_file_actions_adddup2 posix_spawn_file_actions_addfchdir_np
posix_spawn_file_actions_addopen posix_spawn_file_actions_addtcsetpgrp_np posix_spawn_file_actions_destroy
posix_spawn_file_actions_init posix_spawnattr_destroy posix_spawnattr_getflags posix_spawnattr_getpgroup
posix_spawnattr_getschedparam posix_spawnattr_getschedpolicy posix_spawnattr_getsigdefault posix_spawnattr_getsigmask
posix_spawnattr_init posix_spawnattr_setflags posix_spawnattr_setpgroup posix_spawnattr_setschedparam
posix_spawnattr_setschedpolicy posix_spawnattr_setsigdefault posix_spawnattr_setsigmask posix_spawnp postorder pow
ppoll prctl prctl_mm_map pread preadv preadv2 preadv64v2 preorder printf prlimit process_madvise process_mrelease
process_vm_readv process_vm_writev profil program_invocation_name program_invocation_short_name protoent pselect
psiginfo psignal pthread_atfork pthread_attr_destroy pthread_attr_getaffinity_np pthread_attr_getdetachstate
pthread_attr_getguardsize pthread_attr_getinheritsched pthread_attr_getschedparam pthread_attr_getschedpolicy
pthread_attr_getscope pthread_attr_getsigmask_np pthread_attr_getstack pthread_attr_getstackaddr
pthread_attr_getstacksize pthread_attr_init pthread_attr_setaffinity_np pthread_attr_setdetachstate
pthread_attr_setguardsize pthread_attr_setinheritsched pthread_attr_setschedparam pthread_attr_setschedpolicy
pthread_attr_setscope pthread_attr_setsigmask_np pthread_attr_setstack pthread_attr_setstackaddr
pthread_attr_setstacksize pthread_barrier_destroy pthread_barrier_init pthread_barrier_wait pthread_barrierattr_destroy
pthread_barrierattr_getpshared pthread_barrierattr_init pthread_barrierattr_setpshared pthread_cancel
pthread_clockjoin_np pthread_cond_broadcast pthread_cond_clockwait pthread_cond_destroy pthread_cond_init
pthread_cond_signal pthread_cond_timedwait pthread_cond_wait pthread_condattr_destroy pthread_condattr_getclock
pthread_condattr_getpshared pthread_condattr_init pthread_condattr_setclock pthread_condattr_setpshared pthread_create
pthread_detach pthread_equal pthread_exit pthread_getaffinity_np pthread_getattr_default_np pthread_getattr_np
pthread_getconcurrency pthread_getcpuclockid pthread_getname_np pthread_getschedparam pthread_getspecific pthread_join
pthread_key_create pthread_key_delete pthread_kill pthread_mutex_clocklock pthread_mutex_consistent
pthread_mutex_destroy pthread_mutex_getprioceiling pthread_mutex_init pthread_mutex_lock pthread_mutex_setprioceiling
pthread_mutex_timedlock pthread_mutex_trylock pthread_mutex_unlock pthread_mutexattr_destroy
pthread_mutexattr_getprioceiling pthread_mutexattr_getprotocol pthread_mutexattr_getpshared pthread_mutexattr_getrobust
pthread_mutexattr_gettype pthread_mutexattr_init pthread_mutexattr_setprioceiling pthread_mutexattr_setprotocol
pthread_mutexattr_setpshared pthread_mutexattr_setrobust pthread_mutexattr_settype pthread_once
pthread_rwlock_clockrdlock pthread_rwlock_clockwrlock pthread_rwlock_destroy pthread_rwlock_init pthread_rwlock_rdlock
pthread_rwlock_timedrdlock pthread_rwlock_timedwrlock pthread_rwlock_tryrdlock pthread_rwlock_trywrlock
pthread_rwlock_unlock pthread_rwlock_wrlock pthread_rwlockattr_destroy pthread_rwlockattr_getkind_np
pthread_rwlockattr_getpshared pthread_rwlockattr_init pthread_rwlockattr_setkind_np pthread_rwlockattr_setpshared
pthread_self pthread_setaffinity_np pthread_setattr_default_np pthread_setcancelstate pthread_setcanceltype
pthread_setconcurrency pthread_setname_np pthread_setschedparam pthread_setschedprio pthread_setspecific
pthread_sigmask pthread_sigqueue pthread_spin_destroy pthread_spin_init pthread_spin_lock pthread_spin_trylock
pthread_spin_unlock pthread_testcancel pthread_timedjoin_np pthread_tryjoin_np pthread_yield ptsname putc putchar
putenv putgrent putpwent puts putw putwc putwchar pvalloc pwrite pwritev pwritev2 pwritev64v2 qecvt qelem qfcvt qgcvt
qsort quick_exit raise rand random random_data rawmemchr rcmd rcmd_af re_compile_fastmap re_compile_pattern re_match
re_match_2 re_pattern_buffer re_registers re_search re_search_2 re_set_registers re_set_syntax re_syntax_options read
readahead readdir readdir64_r readlink readlinkat readv realloc reallocarray realpath reboot recv recvfrom recvmmsg
recvmsg regcomp regerror regexec regfree remainder remap_file_pages remove remque remquo rename renameat renameat2
required_argument revoke rewind rewinddir rexec rexec_af rindex rint rlimit rmdir round roundeven rpcent rpmatch
rresvport rresvport_af rusage ruserok ruserok_af s6_addr s6_addr16 s6_addr32 sa_handler sa_sigaction sbrk scalb scalbln
scalbn scandir scandirat scanf sched_get_priority_max sched_get_priority_min sched_getaffinity sched_getcpu
sched_getparam sched_getscheduler sched_param sched_priority sched_rr_get_interval sched_setaffinity sched_setparam
sched_setscheduler sched_yield secure_getenv seed48 seekdir select sem_clockwait sem_close sem_destroy sem_getvalue
sem_init sem_open sem_post sem_timedwait sem_trywait sem_unlink sem_wait sembuf semctl semget semid_ds seminfo semop
semtimedop send sendfile sendmmsg sendmsg sendto servent setbuf setbuffer setcontext setdomainname setegid setenv
seteuid setgid setgrent setgroups sethostent sethostid sethostname setipv4sourcefilter setitimer setjmp setlinebuf
setlocale setlogin setlogmask setnetent setnetgrent setns setpayload setpayloadsig setpgid setpgrp setpriority
setprotoent setpwent setregid setresgid setresuid setreuid setrlimit setrpcent setservent setsid setsockopt
setsourcefilter setstate settimeofday setuid setusershell setvbuf shm_info shm_open shm_unlink shmat shmctl shmdt
shmget shmid_ds shminfo shutdown si_addr si_addr_lsb si_arch si_band si_call_addr si_fd si_int si_lower si_overrun
si_pid si_pkey si_ptr si_status si_stime si_syscall si_timerid si_uid si_upper si_utime si_value sigabbrev_np sigaction
sigaddset sigaltstack sigandset sigblock sigcontext sigdelset sigdescr_np sigemptyset sigev_notify_attributes
sigev_notify_function sigevent sigfillset siggetmask sighold sigignore siginterrupt sigisemptyset sigismember
sigjmp_buf siglongjmp signal signbit signgam significand sigorset sigpause sigpending sigprocmask sigqueue sigrelse
sigreturn sigset sigsetmask sigstack sigsuspend sigtimedwait sigval sigwait sigwaitinfo sin sincos sinh sleep snprintf
sockaddr sockaddr_in sockaddr_in6 sockaddr_storage sockaddr_un sockatmark socket socketpair splice sprintf sqrt srand
srand48 srandom sscanf ssignal st_atime st_ctime st_mtime stat statvfs statx statx_timestamp stderr stdin stdout stpcpy
stpncpy strcasecmp strcasestr strcat strchr strchrnul strcmp strcoll strcpy strcspn strdup strerror strerrordesc_np
strerrorname_np strfmon strfromd strfromf strfromf128 strfromf32 strfromf32x strfromf64x strfroml strfry strftime
strlen strncasecmp strncat strncmp strncpy strndup strnlen strpbrk strptime strrchr strsep strsignal strspn strstr
strtod strtof strtof128 strtof32 strtof32x strtof64_l strtof64x strtoimax strtok strtol strtold strtoll_l strtoq
strtoul strtoull_l strtoumax strtouq strverscmp strxfrm swab swapcontext swprintf swscanf symlink symlinkat sync
sync_file_range syncfs syscall sysconf syslog system sysv_signal tan tanh tcdrain tcflow tcflush tcgetattr tcgetpgrp
tcgetsid tcp_ca_state tcp_cookie_transactions tcp_info tcp_md5sig tcp_repair_opt tcp_repair_window tcp_seq
tcp_zerocopy_receive tcphdr tcsendbreak tcsetattr tcsetpgrp tdelete tdestroy tee telldir tempnam termio termios
textdomain tfind tgamma tgkill time timegm timelocal timer_create timer_delete timer_getoverrun timer_gettime
timer_settime timerfd_create timerfd_gettime timerfd_settime times timespec timespec_get timespec_getres timeval timex
timezone tm tmpfile tmpnam tms toascii tolower totalorder totalordermag toupper towctrans towlower towupper trunc
truncate tsearch ttyname ttyslot twalk tzname tzset u_char u_int u_long u_short ualarm ucred ufromfp ufromfpx uint
ulong umask uname ungetc ungetwc unix unlink unlinkat unlockpt unsetenv unshare uselocale ushort usleep utimbuf utime
utimensat utimes utsname va_list valloc vasprintf vdprintf versionsort vfork vfprintf vfscanf vfwprintf vfwscanf
vhangup vmsplice vprintf vscanf vsnprintf vsprintf vsscanf vswprintf vswscanf vsyslog vwprintf vwscanf wait wait3 wait4
waitid waitpid wcpcpy wcpncpy wcrtomb wcscasecmp wcscat wcschr wcschrnul wcscmp wcscoll wcscpy wcscspn wcsdup wcsftime
wcslen wcsncasecmp wcsncat wcsncmp wcsncpy wcsnlen wcsnrtombs wcspbrk wcsrchr wcsrtombs wcsspn wcsstr wcstod wcstof
wcstof128 wcstof32 wcstof32x wcstof64_l wcstof64x wcstoimax wcstok wcstol wcstold wcstoll_l wcstombs wcstoq wcstoul
wcstoull_l wcstoumax wcstouq wcswcs wcswidth wcsxfrm wctob wctomb wctrans wctype wcwidth winsize wmemchr wmemcmp
wmemcpy wmemmove wmempcpy wmemset wordexp wordfree wprintf write writev wscanf y0 y1 yn
"""
