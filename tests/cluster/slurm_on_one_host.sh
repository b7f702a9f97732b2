#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A real Slurm for tests: munged, slurmctld and a slurmd for each of several nodes, all on this host, in a folder of
# their own, without root's help, systemd or a network. Nodes n1, n2, ... get process ids and a host name of their own
# where the kernel allows it, so that one can crash with everything on it.
#
#   slurm_on_one_host.sh up FOLDER NODES CPUS    start; FOLDER is absolute, at most 70 characters, and not writable by others
#   slurm_on_one_host.sh down FOLDER             cancel jobs, end every daemon
#   slurm_on_one_host.sh crash FOLDER NODE       SIGKILL for a node's daemon and all its processes
#   slurm_on_one_host.sh revive FOLDER NODE      start the node again
#
# Clients find it by SLURM_CONF=FOLDER/slurm.conf.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin

readonly verb=$1 folder=$2
export SLURM_CONF=$folder/slurm.conf

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# eventually SECONDS COMMAND...: whether the command succeeds within that time.
eventually() {
  local deadline=$((SECONDS + $1))
  shift
  while ! "$@" >/dev/null 2>&1; do
    if ((SECONDS >= deadline)); then return 1; fi
    sleep 0.05
  done
}

# Ticks since boot at which a process started, "" for one that is gone: ids are used again, pairs of both are not.
born() { awk '{ sub(/.*\) /, ""); if ($1 != "Z") print $20 }' "/proc/$1/stat" 2>/dev/null || true; }

# launch NAME COMMAND...: a daemon in a session of its own, which is noted so that it can be ended.
launch() {
  local name=$1
  shift
  setsid "$@" </dev/null >>"$folder/log/$name.out" 2>&1 &
  local id=$!
  printf '%s %s\n' "$id" "$(born "$id")" >"$folder/daemons/$name"
}

# The id of a launched daemon that still runs.
idOf() {
  local id start
  [[ -r $folder/daemons/$1 ]] && read -r id start <"$folder/daemons/$1" && [[ -n $start && $(born "$id") == "$start" ]] &&
    printf '%s' "$id"
}

# finish NAME SIGNAL
finish() {
  local id
  if id=$(idOf "$1"); then
    kill -s "$2" "$id" || true
    eventually 5 isGone "$id" || kill -s KILL "$id" || true
  fi
  rm -f "$folder/daemons/$1"
}
isGone() { [[ -z $(born "$1") ]]; }

# Options of unshare for a node, none where namespaces are not to be had.
isolation() {
  local options=(--pid --fork --kill-child --mount-proc --uts)
  ((EUID == 0)) || options+=(--user --map-current-user --keep-caps)
  if unshare "${options[@]}" hostname probe 2>/dev/null; then printf '%s ' "${options[@]}"; fi
}

launchNode() {
  local options
  read -ra options <"$folder/isolation" || true
  if ((${#options[@]})); then
    # The first process of the namespace must reap what others leave behind, which slurmd does not.
    # shellcheck disable=SC2016
    launch "$1" unshare "${options[@]}" sh -c 'hostname "$0"; slurmd -D -N "$0" & wait' "$1"
  else
    launch "$1" slurmd -D -N "$1"
  fi
}

# Processes of a node without namespaces: those that hold its stepds' sockets, with all that they started.
processesOf() {
  local inodes queue id
  inodes=$(awk -v prefix="$folder/spool/$1/" 'index($8, prefix) == 1 { print $7 }' /proc/net/unix)
  queue=$(for inode in $inodes; do
    { find /proc/[0-9]*/fd -lname "socket:\\[$inode\\]" 2>/dev/null || true; } | cut -d/ -f3
  done | sort -u)
  while [[ -n $queue ]]; do
    printf '%s\n' "$queue"
    queue=$(for id in $queue; do cat "/proc/$id/task"/*/children 2>/dev/null || true; done | tr ' ' '\n' | sed '/^$/d')
  done
}

crash() {
  local others=''
  [[ -s $folder/isolation ]] || others=$(processesOf "$1")
  finish "$1" KILL
  for id in $others; do kill -s KILL "$id" 2>/dev/null || true; done
}

unusedPorts() { # unusedPorts COUNT: the first of so many in a row
  local first=$((17000 + RANDOM % 12000)) i
  while ((first < 32000)); do
    for ((i = 0; i < $1; ++i)); do
      if (: <"/dev/tcp/127.0.0.1/$((first + i))") 2>/dev/null; then break; fi
    done
    if ((i == $1)); then
      printf '%s' "$first"
      return
    fi
    first=$((first + i + 1))
  done
  fail "no unused ports"
}

configure() { # configure NODES CPUS
  local port
  port=$(unusedPorts $(($1 + 1)))
  {
    cat <<CONF
ClusterName=limen_test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool/%n
SlurmctldPidFile=$folder/log/slurmctld.pid
SlurmdPidFile=$folder/log/%n.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/%n.log
AuthType=auth/munge
CredType=cred/munge
# A requeued job waits for its credential to expire: 120 s by default, and with less than 5 as well.
AuthInfo=socket=$folder/munge/socket,cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
ReturnToService=2
JobRequeue=1
SlurmdTimeout=3
BatchStartTimeout=3
KillWait=1
MinJobAge=3600
MessageTimeout=5
PropagateResourceLimits=NONE
SlurmdParameters=config_overrides
CONF
    # With no address but loopback's the resolver finds no IPv4 for Slurm, unless any family will do.
    getent ahostsv4 127.0.0.1 >/dev/null || echo CommunicationParameters=EnableIPv6
    local i
    for ((i = 1; i <= $1; ++i)); do
      echo "NodeName=n$i NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + i)) CPUs=$2 RealMemory=4000"
    done
    echo "PartitionName=test Nodes=n[1-$1] Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO"
  } >"$SLURM_CONF"
}

areIdle() { [[ $(sinfo -h -N -o %T | sort | uniq -c | xargs) == "$1 idle" ]]; }
isUp() { [[ $(scontrol ping) == *UP* ]]; }
isEmpty() { [[ -z $(squeue -h) ]]; }

up() { # up NODES CPUS
  local program i
  for program in munged mungekey slurmctld slurmd sbatch; do
    command -v "$program" >/dev/null || {
      printf '%s\n' "no $program: apt-get install --no-install-recommends slurm-wlm munge" >&2
      exit 3
    }
  done
  ((${#folder} <= 70)) || fail "$folder: longer than the 70 characters that sockets in it allow"
  mkdir -p "$folder"/{munge,state,spool,log,daemons}
  chmod 755 "$folder/munge"
  for ((i = 1; i <= $1; ++i)); do mkdir -p "$folder/spool/n$i"; done
  isolation >"$folder/isolation"
  configure "$1" "$2"
  mungekey --create --keyfile="$folder/munge/key"
  launch munged munged --foreground --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/log/munged.pid" --log-file="$folder/log/munged.log" --seed-file="$folder/munge/seed"
  eventually 10 munge --no-input --socket="$folder/munge/socket" || fail "munged: $(tail -n 3 "$folder/log/munged.out")"
  launch slurmctld slurmctld -D
  eventually 20 isUp || fail "slurmctld: $(tail -n 3 "$folder/log/slurmctld.out")"
  for ((i = 1; i <= $1; ++i)); do launchNode "n$i"; done
  eventually 20 areIdle "$1" || fail "nodes: $(sinfo -N) $(tail -n 3 "$folder"/log/n*.out)"
}

down() {
  local note
  if idOf slurmctld >/dev/null; then
    scancel --user="$(id -un)" || true
    eventually 5 isEmpty || true
  fi
  for note in "$folder"/daemons/n*; do [[ ! -e $note ]] || crash "${note##*/}"; done
  finish slurmctld KILL
  finish munged TERM
}

case $verb in
  up) up "$3" "$4" ;;
  down) down ;;
  crash) crash "$3" ;;
  revive) launchNode "$3" ;;
  *) fail "no verb '$verb'" ;;
esac
