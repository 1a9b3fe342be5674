#!/usr/bin/env python3
"""recipes_test.py WALKTRACK SOURCE_DIR
What scripts/cluster holds for engines that are not here: fields that Kubernetes and AWS Batch know, options that the
program knows, shares that add up; and a container whose packages are those of scripts/setup.sh."""
import json
import pathlib
import re
import shlex
import subprocess
import sys

# Fields by the place of their object, of batch/v1 Job (kubernetes.io/docs/reference) and of RegisterJobDefinition and
# SubmitJob (docs.aws.amazon.com/batch/latest/APIReference); those that may be here.
JOB = {
    "": {"apiVersion", "kind", "metadata", "spec"},
    "metadata": {"name", "namespace", "labels", "annotations"},
    "spec": {"completionMode", "completions", "parallelism", "backoffLimit", "podFailurePolicy", "template",
             "ttlSecondsAfterFinished", "activeDeadlineSeconds", "suspend"},
    "spec.podFailurePolicy": {"rules"},
    "spec.podFailurePolicy.rules": {"action", "onExitCodes", "onPodConditions"},
    "spec.podFailurePolicy.rules.onExitCodes": {"containerName", "operator", "values"},
    "spec.podFailurePolicy.rules.onPodConditions": {"type", "status"},
    "spec.template": {"metadata", "spec"},
    "spec.template.spec": {"restartPolicy", "automountServiceAccountToken", "securityContext", "containers", "volumes",
                           "nodeSelector", "tolerations", "affinity"},
    "spec.template.spec.securityContext": {"runAsNonRoot", "runAsUser", "runAsGroup", "fsGroup"},
    "spec.template.spec.containers": {"name", "image", "command", "args", "env", "resources", "securityContext", "volumeMounts"},
    "spec.template.spec.containers.resources": {"requests", "limits"},
    "spec.template.spec.containers.resources.requests": {"cpu", "memory", "ephemeral-storage"},
    "spec.template.spec.containers.resources.limits": {"cpu", "memory", "ephemeral-storage"},
    "spec.template.spec.containers.securityContext": {"allowPrivilegeEscalation", "readOnlyRootFilesystem", "capabilities"},
    "spec.template.spec.containers.securityContext.capabilities": {"drop", "add"},
    "spec.template.spec.containers.volumeMounts": {"name", "mountPath", "readOnly", "subPath"},
    "spec.template.spec.volumes": {"name", "persistentVolumeClaim", "emptyDir"},
    "spec.template.spec.volumes.persistentVolumeClaim": {"claimName", "readOnly"},
    "spec.template.spec.volumes.emptyDir": {"medium", "sizeLimit"},
}
DEFINITION = {
    "": {"jobDefinitionName", "type", "platformCapabilities", "retryStrategy", "timeout", "containerProperties"},
    "retryStrategy": {"attempts", "evaluateOnExit"},
    "retryStrategy.evaluateOnExit": {"action", "onExitCode", "onReason", "onStatusReason"},
    "containerProperties": {"image", "command", "user", "readonlyRootFilesystem", "resourceRequirements", "mountPoints",
                            "volumes", "environment", "jobRoleArn", "executionRoleArn"},
    "containerProperties.resourceRequirements": {"type", "value"},
    "containerProperties.mountPoints": {"sourceVolume", "containerPath", "readOnly"},
    "containerProperties.volumes": {"name", "host", "efsVolumeConfiguration"},
    "containerProperties.volumes.efsVolumeConfiguration": {"fileSystemId", "rootDirectory", "transitEncryption"},
}
SUBMIT = {"": {"jobName", "jobQueue", "jobDefinition", "arrayProperties", "parameters"}, "arrayProperties": {"size"}}


def check_fields(value, known, place=""):
    if isinstance(value, list):
        for each in value:
            check_fields(each, known, place)
    elif isinstance(value, dict):
        assert place in known, f"{place}: holds fields, and nobody says which"
        assert set(value) <= known[place], f"{place}: {set(value) - known[place]}"
        for key, each in value.items():
            check_fields(each, known, f"{place}.{key}".strip("."))


def options_of(command):
    """Of the batch in a shell's line."""
    batch = command.split("walktrack batch ", 1)[1].split("||")[0]
    return [word for word in shlex.split(batch) if word.startswith("--")]


def read_yaml(path):
    try:
        import yaml
    except ImportError:
        print(f"{path.name}: SKIPPED, python3-yaml is not installed")
        return None
    return yaml.safe_load(path.read_text())


def check_kubernetes(path, known_options):
    job = read_yaml(path)
    if job is None:
        return
    check_fields(job, JOB)
    spec, pod = job["spec"], job["spec"]["template"]["spec"]
    (container,) = pod["containers"]
    assert job["apiVersion"] == "batch/v1" and job["kind"] == "Job" and spec["completionMode"] == "Indexed"
    assert spec["parallelism"] <= spec["completions"] and pod["restartPolicy"] == "Never"  # podFailurePolicy asks for it
    (line,) = container["args"]
    assert f"--shard auto/{spec['completions']} " in line, "as many shares as workers"
    assert set(options_of(line)) <= known_options
    jobs, threads = (int(re.search(rf"--{word} (\d+)", line)[1]) for word in ("jobs", "threads"))
    assert jobs * threads == int(container["resources"]["limits"]["cpu"]), "as many threads as CPUs"
    mounted = {mount["name"]: mount["mountPath"] for mount in container["volumeMounts"]}
    assert set(mounted) == {volume["name"] for volume in pod["volumes"]}
    for rule in spec["podFailurePolicy"]["rules"]:
        for code in rule.get("onExitCodes", {}).get("values", []):
            assert code in (2, 3), "those that are not worth a retry (apps/guide/programs.md)"
        assert rule.get("onExitCodes", {}).get("containerName", container["name"]) == container["name"]


def check_aws(folder, known_options):
    definition = json.loads((folder / "aws_batch_definition.json").read_text())
    submit = json.loads((folder / "aws_batch_submit.json").read_text())
    check_fields(definition, DEFINITION)
    check_fields(submit, SUBMIT)
    assert submit["jobDefinition"] == definition["jobDefinitionName"]
    assert 2 <= submit["arrayProperties"]["size"] <= 10_000
    container = definition["containerProperties"]
    line = container["command"][-1]
    assert "--shard auto " in line and set(options_of(line)) <= known_options
    needs = {need["type"]: int(need["value"]) for need in container["resourceRequirements"]}
    assert f"--jobs {needs['VCPU']} --threads 1 " in line
    assert {m["sourceVolume"] for m in container["mountPoints"]} == {v["name"] for v in container["volumes"]}


def check_container(source):
    """Packages for building are setup.sh's, which the file runs; those for running are the Debian package's own."""
    text = (source / "scripts/cluster/Containerfile").read_text()
    steps = [line for line in re.sub(r"\\\n", " ", text).splitlines() if line and not line.startswith("#")]
    words = [step.split() for step in steps]
    assert {w[0] for w in words} <= {"ARG", "FROM", "WORKDIR", "COPY", "RUN", "USER", "CMD"}, "words of a Containerfile"
    stages = [i for i, w in enumerate(words) if w[0] == "FROM"]
    assert len(stages) == 2 and all(words[i][1] == "${BASE}" for i in stages)
    assert any("scripts/setup.sh" in step and step.startswith("RUN") for step in steps[:stages[1]])
    for w in words[:stages[1]]:
        if w[0] == "COPY":
            assert all((source / place).exists() for place in w[1:-1]), f"{' '.join(w)}: not there"
    listed = set(re.findall(r"\blib[\w+-]+(?:-dev|\d)\b", text))
    assert not listed, f"packages that setup.sh or the Debian package should bring: {listed}"
    run = steps[stages[1]:]
    assert sum(step.startswith("USER") for step in run) == 1 and not any("USER root" in step for step in run)
    assert run.index(next(s for s in run if s.startswith("USER"))) > max(i for i, s in enumerate(run) if s.startswith("RUN"))


def main():
    walktrack, source = sys.argv[1], pathlib.Path(sys.argv[2])
    words = subprocess.run([walktrack, "batch", "--help-words"], capture_output=True, text=True, check=True).stdout
    known_options = set(words.replace("=", " ").split())
    folder = source / "scripts/cluster"
    check_kubernetes(folder / "kubernetes.yaml", known_options)
    check_aws(folder, known_options)
    check_container(source)
    for recipe in [*folder.glob("*.sh"), folder / "Snakefile"]:
        unknown = {w for w in re.findall(r"(?<![\w-])--[a-z][a-z-]+", recipe.read_text())} - known_options - {
            "--parsable", "--array", "--cpus-per-task", "--output", "--dependency", "--job-name", "--will-cite", "--sshlogin",
            "--config"}
        assert not unknown, f"{recipe.name}: {unknown}"
    print("recipes have the form that their engines ask for")


if __name__ == "__main__":
    main()
