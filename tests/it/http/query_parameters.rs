//! Queries: unknown parameters, notations of lists, missing parameters.

use axum::body::Body;
use axum::http::{Method, Request};
use serde_json::{Value, json};

use super::{Reply, get, get_from, json_request, post, send, service};

fn pointers(reply: &Reply) -> Vec<&str> {
    reply.json["errors"].as_array().unwrap().iter().map(|error| error["pointer"].as_str().unwrap()).collect()
}

/// Every operation of the document refuses a parameter that it does not document, and says which it has.
#[tokio::test]
async fn every_operation_refuses_unknown_parameters() {
    let service = service().await;
    let document = get_from(&service, "/openapi.json", &[]).await.json;
    let mut asked = 0;
    for (path, operations) in document["paths"].as_object().unwrap() {
        for (method, operation) in operations.as_object().unwrap() {
            let method = Method::from_bytes(method.to_ascii_uppercase().as_bytes()).unwrap();
            let uri = format!("{}?surprise=1", path.replace(['{', '}'], "x"));
            let reply = super::send_to(service.clone(), json_request(method, &uri, "{}")).await;
            reply.assert_problem(422, "invalid_request");
            assert_eq!(pointers(&reply), ["/query/surprise"], "{path}");
            let known = operation["parameters"].as_array().into_iter().flatten();
            for parameter in known.filter(|parameter| parameter["in"] == "query") {
                let name = parameter["name"].as_str().unwrap();
                assert!(reply.json["detail"].as_str().unwrap().contains(name), "{path} {name}");
            }
            asked += 1;
        }
    }
    assert!(asked > 20);
}

#[tokio::test]
async fn a_body_field_is_refused_in_the_query() {
    let question = json!({"joints": {"rho": [674, 685, 250]}});
    post("/fk?solutions=all", question).await.assert_bad_field("/query/solutions");
    post("/workspace?kind=tool", "{}").await.assert_bad_field("/query/kind");
    get("/machines?limit=1").await.assert_bad_field("/query/limit");
    let head = Request::head("/machines?limit=1").body(Body::empty()).unwrap();
    assert_eq!(send(head).await.status, 422);
    let many = (0..1000).fold("/machines?a".to_owned(), |uri, i| format!("{uri}&a{i}"));
    assert_eq!(pointers(&get(&many).await).len(), 10, "the list is bounded");
}

#[tokio::test]
async fn lists_are_accepted_in_every_notation() {
    let plain = get("/fk?rho=674,685,250&near_joints=1,2,3,4,5").await;
    assert_eq!(plain.solutions().len(), 1);
    for query in [
        "rho=674&rho=685&rho=250&near_joints=1&near_joints=2&near_joints=3&near_joints=4&near_joints=5",
        "rho=[674,685,250]&near_joints=[1,2,3,4,5]",
        "rho=%5B674%2C+685%2C+250%5D&near_joints=1,2&near_joints=3,4,5",
        "near_joints=1,2,3,4,5&rho=674&tool_length=0&rho=685,250",
    ] {
        let reply = get(&format!("/fk?{query}")).await;
        assert_eq!(reply.json, plain.json, "{query}");
    }
    let axis = get("/ik?x=100&y=50&z=150&axis=0&axis=0&axis=1").await;
    assert_eq!(axis.json, get("/ik?x=100&y=50&z=150&axis=0,0,1").await.json);
    for query in ["rho=1&rho=2", "rho=1&rho=2&rho=3&rho=4", "rho=[1,2]", "rho=[1,2,3", "rho=1&rho=x&rho=3"] {
        get(&format!("/fk?{query}")).await.assert_bad_field("/query/rho");
    }
    get("/fk?rho=1,2,3&tool_length=1&tool_length=2").await.assert_bad_field("/query/tool_length");
}

#[tokio::test]
async fn words_say_what_a_number_must_be() {
    let number = "must be a number";
    let whole = "must be a whole number, not negative";
    for (uri, name, detail) in [
        ("/ik?x=0&y=fifty&z=300", "y", number),
        ("/ik?x=0&y=&z=300", "y", number),
        ("/ik?x=0&y=1&z=300&phi1=up", "phi1", number),
        ("/fk?rho=1,2,3&tool_length=1mm", "tool_length", number),
        ("/fk?rho=1,2,3&jacobian=yes", "jacobian", "must be true or false"),
        ("/workspace?tolerance=fine", "tolerance", number),
        ("/jobs?limit=-1", "limit", whole),
        ("/jobs?limit=", "limit", whole),
        ("/toolpath/x/rows?from=1.5", "from", whole),
        ("/toolpath/x/rows?from=99999999999999999999", "from", "must be a smaller whole number"),
    ] {
        let reply = get(uri).await;
        reply.assert_bad_field(&format!("/query/{name}"));
        assert_eq!(reply.json["errors"][0]["detail"], detail, "{uri}");
    }
}

#[tokio::test]
async fn the_alphas_of_a_slice_are_a_list() {
    let service = service().await;
    let id = get_from(&service, "/workspace?tolerance=20", &[]).await.json["id"].as_str().unwrap().to_owned();
    let slice = |query: &'static str| {
        let uri = format!("/workspace/{id}/slice?z=1200&{query}");
        let service = service.clone();
        async move { get_from(&service, &uri, &[]).await.json["contours"].clone() }
    };
    let plain = slice("alpha=-5,5").await;
    assert!(plain.as_array().unwrap().len() > 1, "{plain}");
    assert_eq!(slice("alpha=-5&alpha=5").await, plain);
    assert_eq!(slice("alpha=[-5,5]").await, plain);
}

#[tokio::test]
async fn a_problem_lists_all_missing_parameters() {
    let reply = get("/ik?y=1").await;
    reply.assert_problem(422, "invalid_request");
    assert_eq!(pointers(&reply), ["/query/x", "/query/z"]);
    assert!(reply.json["detail"].as_str().unwrap().starts_with("`x` is missing"), "{}", reply.json);
    let one = get("/fk").await;
    one.assert_bad_field("/query/rho");
    assert_eq!(one.json["detail"], "`rho` is missing.");

    let machine: Value = serde_json::from_str(include_str!("../../reference/machine-verne.json")).unwrap();
    let mut short = machine.clone();
    for (object, field) in [("geometry", "R1"), ("geometry", "L2"), ("limits", "tilt")] {
        short[object].as_object_mut().unwrap().remove(field);
    }
    for (path, body, missing) in [
        ("/ik", json!({}), vec!["/pose"]),
        ("/ik", json!({"pose": {"y": 1}}), vec!["/pose/x", "/pose/z"]),
        ("/fk", json!({"joints": {"theta1": 1}}), vec!["/joints/rho"]),
        ("/workspace/dexterity", json!({"phi1": {}}), vec!["/phi1/from", "/phi1/to"]),
        ("/ik/batch", json!({"tool_length": 1}), vec!["/poses"]),
        (
            "/ik",
            json!({"machine": short, "pose": {"y": 1}}),
            vec![
                "/machine/geometry/L2",
                "/machine/geometry/R1",
                "/machine/limits/tilt",
                "/pose/x",
                "/pose/z",
            ],
        ),
    ] {
        let reply = post(path, &body).await;
        let mut found = pointers(&reply);
        let first = found[0].rsplit('/').next().unwrap().to_owned();
        assert!(
            reply.json["detail"].as_str().unwrap().starts_with(&format!("`{first}` is missing")),
            "{}",
            reply.json
        );
        found.sort_unstable();
        assert_eq!(found, missing, "{path} {body}");
    }
}
