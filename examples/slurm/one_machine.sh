#!/bin/bash

# one_machine.sh FOLDER: a separate Slurm on this machine only, with all of its files in FOLDER, for trials and tests.
# Source it as root. `start_slurm` starts it, `stop_slurm` ends what it started. Needs the Debian packages slurm-wlm
# and munge.
slurm_folder=$(realpath -m "$1")

write_configuration() {
  mkdir -p "$slurm_folder"/{state,spool,munge}
  cat > "$slurm_folder/slurm.conf" <<END
ClusterName=one_machine
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm_folder/munge/socket
CryptoType=crypto/munge
SlurmctldPort=${SLURM_TRY_PORT:-26817}
SlurmdPort=$((${SLURM_TRY_PORT:-26817} + 1))
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool
SlurmctldPidFile=$slurm_folder/slurmctld.pid
SlurmdPidFile=$slurm_folder/slurmd.pid
SlurmctldLogFile=$slurm_folder/slurmctld.log
SlurmdLogFile=$slurm_folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=60
MpiDefault=pmix
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=8 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF=$slurm_folder/slurm.conf
}

start_munge() {
  head -c 128 /dev/urandom > "$slurm_folder/munge/key"
  chown -R munge: "$slurm_folder/munge" && chmod 400 "$slurm_folder/munge/key" && chmod 755 "$slurm_folder/munge"
  runuser -u munge -- munged --force --key-file "$slurm_folder/munge/key" --socket "$slurm_folder/munge/socket" \
    --pid-file "$slurm_folder/munge/pid" --log-file "$slurm_folder/munge/log" --seed-file "$slurm_folder/munge/seed"
}

start_controller() { slurmctld; }

wait_for_node() {
  for _ in $(seq 60); do
    [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && return
    sleep 0.5
  done
  echo "the node of the Slurm in $slurm_folder does not come up" >&2
  return 1
}

start_slurm() { write_configuration && start_munge && start_controller && slurmd && wait_for_node; }

# end_of PIDFILE: ends its process and waits for it.
end_of() {
  local pid
  pid=$(cat "$1" 2>/dev/null) || return 0
  kill "$pid" 2>/dev/null
  while kill -0 "$pid" 2>/dev/null; do sleep 0.1; done
}

stop_slurm() {
  scancel -u root 2>/dev/null
  for name in slurmd.pid slurmctld.pid munge/pid; do end_of "$slurm_folder/$name"; done
}
